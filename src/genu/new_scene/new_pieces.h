// Which of the meshes of a bone that `genu new` is given are bone, and which are the cartilage on it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/mesh/mesh.h"
#include "genu/new_scene/asked_scene.h"

namespace genu {

/// How a mesh lies on another one.
struct LyingOn {
  double near = 0;    ///< part of its vertices within kCartilageReach of the other
  double height = 0;  ///< m: of these over the other's outward side, the mean
};
LyingOn lying_on(const Mesh& mesh, const Mesh& other);

/// m: of a closed mesh twice its volume over its area, which for a thin sheet is its thickness; 0 for an open one.
double sheet_thickness(const Mesh& mesh);

/// For each mesh whether it is cartilage: a sheet, open or closed and thin, all of it within some mm of another mesh,
/// and on the outward side of that. Of two sheets on each other it is the one further out.
std::vector<bool> seem_cartilage(const std::vector<Mesh>& meshes);

/// What is asked with femur_any and tibia_any sorted into bones and what touches. `choices` gets a line about it where
/// there is something to tell. Empty, with the reasons in `out`, where they cannot be used. Files that cannot be read
/// are left to what reads them next.
[[nodiscard]] std::optional<NewScene> sort_pieces(const NewScene& asked, std::vector<std::string>& choices,
                                                  Diagnostics& out);

}  // namespace genu
