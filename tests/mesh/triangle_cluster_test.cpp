// What a ray is told that it can meet while it moves is all that it meets, however it moves.
#include <gtest/gtest.h>

#include "genu/core/pose.h"
#include "genu/mesh/triangle_tree.h"
#include "support/layers.h"
#include "support/random_points.h"

namespace genu {
namespace {

/// A ray and the margin that it is asked for; moved by less than a length at both ends, and so everywhere.
struct MovingRay {
  Vec3 origin, direction;
  double length;

  MovingRay moved(const Vec3& start, const Vec3& end) const {
    const Vec3 from = origin + start, to = origin + length * direction + end;
    return {from, (to - from).normalized(), length};
  }
};

;

/// Balls of 20 mm with triangles from coarse to fine, slivers among them, near and 1 m from the origin.
std::vector<Mesh> meshes() {
  std::vector<Mesh> out = {test::ball(0.02, 1.5e-3), test::ball(0.02, 6e-3), test::sheet(0.02, 40)};
  Mesh flat = test::ball(0.02, 3e-3);
  for (Vec3& v : flat.vertices) v.z() *= 0.02;
  out.push_back(flat);
  for (Vec3& v : flat.vertices) v += Vec3(1, -0.5, 0.25);
  out.push_back(flat);
  return out;
}

TEST(TriangleCluster, WhatIsListedIsAllThatAMovedRayMeets) {
  constexpr double kLength = 6e-3, kLeast = 1e-4, kMost = 1e-3, kMargin = 1.01 * kMost;
  test::RandomPoints random(5);
  int listed = 0, free = 0, hits = 0, many = 0;
  for (const Mesh& mesh : meshes()) {
    const TriangleTree tree(mesh);
    const Vec3 corner = mesh.vertices[0];
    TrianglesAtRay at;
    for (int k = 0; k < 3000; ++k) {
      const auto& t = mesh.triangles[static_cast<std::size_t>(random.uniform(0, 1) * 0.999 *
                                                              static_cast<double>(mesh.triangles.size()))];
      const Vec3 near = mesh.vertices[static_cast<std::size_t>(t[0])] + random.in_ball(3e-3);
      const MovingRay ray{near, (random.in_ball(1) + 1e-9 * corner).normalized(), kLength};
      ClustersNear clusters;
      tree.clusters_near(ray.origin, ray.direction, kLength, kMargin, clusters);
      tree.at_ray(clusters, ray.origin, ray.direction, kLength, kLeast, kMost, at);
      EXPECT_GE(at.margin, kLeast);
      EXPECT_LE(at.margin, kMost);
      (at.count > 0 ? listed : free) += 1;
      many += at.count > TrianglesAtRay::kMost;
      for (int i = 0; i < 6; ++i) {
        const Vec3 start = random.in_ball(0.999 * at.margin), end = random.in_ball(0.999 * at.margin);
        const MovingRay moved = i == 0 ? ray : ray.moved(start, end);
        // A ray keeps its length; its other end may be a little off.
        const auto expected = test::leaving_by_all(mesh, moved.origin, moved.direction, 0.99 * kLength);
        const auto found =
            at.count > TrianglesAtRay::kMost
                ? tree.leaving(clusters, moved.origin, moved.direction, 0.99 * kLength)
                : tree.leaving(std::span<const int>(at.places.data(), static_cast<std::size_t>(at.count)), moved.origin,
                               moved.direction, 0.99 * kLength);
        ASSERT_EQ(found.triangle >= 0, expected.triangle >= 0) << "ray " << k << " move " << i;
        if (!expected) continue;
        ++hits;
        EXPECT_NEAR(found.distance, expected.distance, 1e-12) << "ray " << k << " move " << i;
      }
    }
  }
  std::printf("%d rays with triangles (%d with too many), %d without; %d hits\n", listed, many, free, hits);
  EXPECT_GT(listed, 1000);
  EXPECT_GT(free, 1000);
  EXPECT_GT(hits, 5000);
}

TEST(TriangleCluster, NoTriangles) {
  const TriangleTree tree;
  ClustersNear clusters;
  tree.clusters_near(Vec3::Zero(), Vec3::UnitX(), 1, 1, clusters);
  EXPECT_EQ(clusters.count, 0);
  TrianglesAtRay at;
  tree.at_ray(clusters, Vec3::Zero(), Vec3::UnitX(), 1, 1e-3, 1e-2, at);
  EXPECT_EQ(at.count, 0);
  EXPECT_EQ(at.margin, 1e-2);
}

}  // namespace
}  // namespace genu
