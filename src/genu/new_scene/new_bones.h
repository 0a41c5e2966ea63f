// The meshes that `genu new` is given.
#pragma once

#include <optional>
#include <string>

#include "genu/core/diagnostics.h"
#include "genu/mesh/mesh.h"
#include "genu/new_scene/asked_scene.h"

namespace genu {

struct NewBone {
  Mesh mesh;
  double unit = 1e-3;
  std::string space;  ///< the frame that its file names
};

/// The meshes of a knee, and those that the reference knee is laid on: bones where there are some.
struct NewBones {
  NewBone femur, tibia;
  std::optional<NewBone> femur_bone, tibia_bone;
  std::optional<NewBone> patella, patella_bone;
  std::optional<NewBone> fibula;

  const Mesh& femur_shape() const { return femur_bone ? femur_bone->mesh : femur.mesh; }
  const Mesh& tibia_shape() const { return tibia_bone ? tibia_bone->mesh : tibia.mesh; }
  /// The frame that the files name; empty where none does.
  const std::string& space() const { return femur.space.empty() ? tibia.space : femur.space; }
};

/// Empty, with the reasons in `out`, where one cannot be read, or they name different frames.
[[nodiscard]] std::optional<NewBones> read_new_bones(const NewScene& asked, Diagnostics& out);

}  // namespace genu
