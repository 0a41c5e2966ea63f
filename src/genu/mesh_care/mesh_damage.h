// What scanners, segmentation and exporters do to meshes, done on purpose: for tests and the catalogue of hard cases.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/mesh/mesh.h"

namespace genu {

enum class MeshDamage {
  // near a place
  fin,
  flipped,
  duplicate,
  hole,
  crossing,
  stray,
  spike,
  slivers,
  // everywhere
  noise,       ///< vertices move by a normal deviate of this size along each axis
  shift,       ///< all of it moves
  scale,       ///< all of it grows by a factor
  inside_out,  ///< every triangle is turned round
  degenerate,  ///< every tenth triangle is followed by one without area
  single,      ///< coordinates are rounded to single precision, in mm
  subdivide,   ///< every triangle becomes four, so often
};

const char* to_string(MeshDamage damage);
std::optional<MeshDamage> mesh_damage_named(const std::string& name);

int nearest_vertex(const Mesh& mesh, const Vec3& place);

/// Triangles whose middle is within `radius` (m) of the place.
std::vector<std::size_t> triangles_near(const Mesh& mesh, const Vec3& place, double radius);

/// The mesh with damage of the first kinds, about `radius` (m) wide, at the vertex next to `place`.
Mesh damaged_near(Mesh mesh, MeshDamage damage, const Vec3& place, double radius);

/// The mesh with damage of the other kinds; the same every time. `size` in m, a factor or a count; `shift` in m.
Mesh damaged(Mesh mesh, MeshDamage damage, double size, const Vec3& shift = Vec3::Zero());

/// Whether a damage is done near a place.
inline bool is_local(MeshDamage damage) { return damage < MeshDamage::noise; }

}  // namespace genu
