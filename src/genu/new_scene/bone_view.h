// Meshes as they look from one side: each pixel shows what is nearest to the viewer.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "genu/mesh/mesh.h"

namespace genu {

/// Seen from far away: no perspective.
struct ViewAxes {
  Vec3 right, up, toward;  ///< unit; toward the viewer

  Vec2 flat(const Vec3& p) const { return {right.dot(p), up.dot(p)}; }  ///< m
};

struct BoneView {
  int width = 0, height = 0;
  double pixel = 1;                ///< m
  Vec2 corner = Vec2::Zero();      ///< m: left and top end of the first pixel, to the right and up
  std::vector<std::int16_t> mesh;  ///< which of the meshes each pixel shows; -1: none. Rows from the top
  std::vector<float> light;        ///< 0 .. 1
  std::vector<float> near;         ///< m toward the viewer; -infinity where nothing is

  /// Whether a point can be seen: nothing is in front of it by more than `by`, m.
  bool shows(const ViewAxes& axes, const Vec3& p, double by) const;
};

/// What lies between `low` and `high` (m, as flat() has it) in square pixels. Triangles are shaded by the mean normals
/// of their corners; edges of what is in front are darkened.
BoneView view_of(std::span<const Mesh* const> meshes, const ViewAxes& axes, const Vec2& low, const Vec2& high,
                 double pixel);

}  // namespace genu
