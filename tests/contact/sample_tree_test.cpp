#include "genu/contact/sample_tree.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "genu/core/pose.h"

namespace genu {
namespace {

std::vector<Vec3> cloud(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> draw(-1, 1);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) points.push_back(Vec3{draw(random), 0.4 * draw(random), 0.1 * draw(random)});
  return points;
}

TEST(SampleTree, HasNoNodeWithoutPoints) { EXPECT_TRUE(build_sample_tree({}).nodes.empty()); }

/// Each sphere holds its samples, each child has its share of its parent's, and leaves hold each sample once.
TEST(SampleTree, HoldsEachSampleInOneLeafAndInAllSpheresAboveIt) {
  for (const int count : {1, 12, 13, 1000}) {
    const std::vector<Vec3> points = cloud(count);
    const SampleTree tree = build_sample_tree(points);
    std::vector<int> seen(points.size());
    for (const SampleNode& node : tree.nodes) {
      for (int k = node.first; k < node.last; ++k) {
        const std::size_t i = at(tree.order[at(k)]);
        EXPECT_LE((points[i] - node.centre).norm(), node.radius * (1 + 1e-12));
        if (node.children < 0) ++seen[i];
      }
      if (node.children < 0) {
        EXPECT_LE(node.last - node.first, 12);
        continue;
      }
      const SampleNode &low = tree.nodes[at(node.children)], &high = tree.nodes[at(node.children + 1)];
      EXPECT_EQ(low.first, node.first);
      EXPECT_EQ(low.last, high.first);
      EXPECT_EQ(high.last, node.last);
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), count);
    EXPECT_EQ(tree.nodes[0].last, count);
  }
}

/// No sample moves farther than its sphere is said to, which for a mere shift is the shift.
TEST(SampleTree, BoundsHowFarItsSamplesMove) {
  const std::vector<Vec3> points = cloud(200);
  const SampleTree tree = build_sample_tree(points);
  for (const double angle : {0.0, 0.02, 1.0, 3.1}) {
    const Pose from{exp_rotation(Vec3(0.3, -0.2, 0.5)), Vec3(1, 2, 3)};
    const Pose to{exp_rotation(angle * Vec3(0.6, 0, 0.8)) * from.R, from.p + Vec3(0.1, -0.3, 0.2)};
    for (const SampleNode& node : tree.nodes) {
      double farthest = 0;
      for (int k = node.first; k < node.last; ++k) {
        const Vec3& x = points[at(tree.order[at(k)])];
        farthest = std::max(farthest, (to * x - from * x).norm());
      }
      EXPECT_LE(farthest, node.motion(from, to) + 1e-12);
      EXPECT_LE(node.motion(from, to), (to.p - from.p).norm() + 3 * angle + 1e-12);
    }
  }
}

}  // namespace
}  // namespace genu
