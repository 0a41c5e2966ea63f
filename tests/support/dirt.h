// What scanners, segmentation and exporters do to meshes, done on purpose at a known place.
#pragma once

#include "genu/mesh_care/mesh_damage.h"

namespace genu::test {

using Dirt = MeshDamage;

inline const char* name_of(Dirt dirt) { return to_string(dirt); }

/// Does it take the surface away, or put something in its way? Otherwise reading mends it.
inline bool is_serious(Dirt dirt) { return dirt != Dirt::flipped && dirt != Dirt::duplicate && dirt != Dirt::slivers; }

/// The mesh with dirt about `radius` (m) wide at a vertex near `place`.
inline Mesh dirtied(const Mesh& mesh, Dirt dirt, const Vec3& place, double radius) {
  return damaged_near(mesh, dirt, place, radius);
}

}  // namespace genu::test
