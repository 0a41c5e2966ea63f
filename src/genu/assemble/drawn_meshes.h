// A scene whose meshes were measured another time: vertices moved along their normals by a random field
// (mesh_care/noise_field.h), and fitted as those of the scene itself are, so that the field alone makes the difference.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/surface/mesh_noise.h"

namespace genu {

/// What moves the mesh of a surface.
struct MeshDraw {
  std::size_t surface = 0;
  MeshNoise noise;
  std::uint64_t draw = 0;  ///< one random field for each number; meshes with the same number are moved by one field
};

/// The mesh of a surface, moved, and how it is fitted.
struct DrawnMesh {
  std::size_t surface = 0;
  Mesh mesh;                         ///< in units of the surface's file
  std::optional<double> fit_radius;  ///< in the scene's unit; as chosen for its own mesh, where the scene gives none
  std::optional<int> degree;         ///< the same
};

/// Moves meshes of a prepared scene. Empty, with errors in `out`, where a mesh cannot be read.
[[nodiscard]] std::optional<std::vector<DrawnMesh>> draw_meshes(const Prepared& prepared,
                                                                const std::vector<MeshDraw>& draws, Diagnostics& out);

/// Prepares `scene`, which has the surfaces of `prepared`, with these meshes. `label` is part of the names under which
/// they are in the library of `prepared` meanwhile: no two calls at a time may have the same.
[[nodiscard]] std::optional<Prepared> prepare_with_meshes(Scene scene, const Prepared& prepared,
                                                          const std::vector<DrawnMesh>& drawn, const std::string& label,
                                                          Diagnostics& out);

/// Writes these meshes and the text of the scene's file with them into `folder`, as NAME.ply and scene.toml. Preparing
/// that gives the bits of prepare_with_meshes(). Errors go to `out`: a surface without a header of its own.
void write_scene_with_meshes(const Prepared& prepared, const std::vector<DrawnMesh>& drawn, const std::string& folder,
                             Diagnostics& out);

}  // namespace genu
