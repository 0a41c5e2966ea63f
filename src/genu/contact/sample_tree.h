// A tree of spheres around the samples of a surface: a bound for a sphere is a bound for its contents.
#pragma once

#include <vector>

#include "genu/core/pose.h"

namespace genu {

/// A sphere around the samples order[first .. last).
struct SampleNode {
  int first = 0, last = 0;
  int children = -1;  ///< index of the first of two, -1 for a leaf
  Vec3 centre;
  double radius = 0;

  /// m: largest motion of a point of the sphere between two poses of the samples.
  double motion(const Pose& from, const Pose& to) const;
};

struct SampleTree {
  std::vector<int> order;         ///< of all points
  std::vector<SampleNode> nodes;  ///< the root first; none where there are no points
};

/// Halves the points along the longest side of their box until a node has at most a dozen.
SampleTree build_sample_tree(const std::vector<Vec3>& points);

}  // namespace genu
