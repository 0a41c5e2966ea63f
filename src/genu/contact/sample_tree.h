// A tree of spheres round the samples of a surface: what is known of a sphere is known of all that it holds.
#pragma once

#include <vector>

#include "genu/core/pose.h"

namespace genu {

/// A sphere round the samples order[first .. last).
struct SampleNode {
  int first = 0, last = 0;
  int children = -1;  ///< index of the first of two, -1 for a leaf
  Vec3 centre;
  double radius = 0;

  /// The farthest (m) that a point of the sphere moves between two poses of the samples.
  double motion(const Pose& from, const Pose& to) const;
};

struct SampleTree {
  std::vector<int> order;         ///< of all points
  std::vector<SampleNode> nodes;  ///< the root first; none where there are no points
};

/// Halves the points along the longest side of their box until a node holds a dozen at most.
SampleTree build_sample_tree(const std::vector<Vec3>& points);

}  // namespace genu
