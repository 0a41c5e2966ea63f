// A tree of spheres around the samples of a surface: a bound for a sphere is a bound for its contents.
#pragma once

#include <cmath>
#include <vector>

#include "genu/core/pose.h"

namespace genu {

/// A sphere around the samples order[first .. last).
struct SampleNode {
  int first = 0, last = 0;
  int children = -1;  ///< index of the first of two, -1 for a leaf
  Vec3 centre;
  double radius = 0;

  /// m: largest motion of a point of the sphere between two poses of the samples. Written out, because every search
  /// asks it of dozens of spheres.
  double motion(const Pose& from, const Pose& to) const {
    double shift = 0, turn = 0;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const double x = to.R(i, 0) - from.R(i, 0), y = to.R(i, 1) - from.R(i, 1), z = to.R(i, 2) - from.R(i, 2);
      const double along = x * centre[0] + y * centre[1] + z * centre[2] + (to.p[i] - from.p[i]);
      shift += along * along;
      turn += x * x + y * y + z * z;
    }
    return std::sqrt(shift) + std::sqrt(0.5 * turn) * radius;
  }
};

struct SampleTree {
  std::vector<int> order;         ///< of all points
  std::vector<SampleNode> nodes;  ///< the root first; none where there are no points
};

/// Halves the points along the longest side of their box until a node has at most a dozen.
SampleTree build_sample_tree(const std::vector<Vec3>& points);

}  // namespace genu
