// What rays remember from earlier poses changes their speed and nothing else.
#include "genu/contact/layer_rays.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "support/layers.h"

namespace genu {
namespace {

std::vector<Ray> rays_of(const Mesh& mesh) {
  std::vector<Ray> rays;
  for (const auto& t : mesh.triangles) {
    const auto v = [&](std::size_t i) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(t[i])]; };
    rays.push_back({(v(0) + v(1) + v(2)) / 3, -(v(1) - v(0)).cross(v(2) - v(0)).normalized()});
  }
  return rays;
}

struct Met {
  int ray, triangle;
  double distance;
  bool operator==(const Met&) const = default;
};

std::vector<Met> cast(const LayerRays& rays, const Pose& X_TC, LayerRays::Memory& memory) {
  std::vector<Met> out;
  rays.cast(X_TC, memory, [&](int ray, const TriangleTree::Hit& hit, const Vec3&, const Vec3&) {
    out.push_back({ray, hit.triangle, hit.distance});
  });
  return out;
}

TEST(LayerRays, WarmIsColdAlongAWander) {
  std::mt19937 random(3);
  std::normal_distribution<double> step(0, 1);
  const LayerRays rays(rays_of(test::sheet(0.02, 25)), std::make_shared<TriangleTree>(test::ball(0.02, 1.5e-3)), 5e-3,
                       LayerRays::Grouping::together);
  LayerRays::Memory warm;
  Pose X{Mat3::Identity(), {0, 0, -0.019}};
  std::size_t most = 0;
  int none = 0;
  for (int k = 0; k < 400; ++k) {
    // Mostly small steps, now and then a leap.
    const double size = k % 40 == 39 ? 0.01 : 3e-4;
    Vec6 twist;
    for (int i = 0; i < 6; ++i) twist[i] = size * step(random) * (i < 3 ? 1 : 30);
    X = retract(X, twist);
    if (X.p.norm() > 0.03) X.p *= 0.5;
    LayerRays::Memory cold;
    const auto expected = cast(rays, X, cold), found = cast(rays, X, warm);
    ASSERT_EQ(found, expected) << "pose " << k;
    most = std::max(most, found.size());
    none += found.empty() ? 1 : 0;
  }
  EXPECT_GT(most, 50u);
  EXPECT_GT(none, 10);
}

TEST(LayerRays, EveryRayThatMeetsIsVisitedOnce) {
  const Mesh casting = test::sheet(0.02, 25), target = test::ball(0.02, 1.5e-3);
  const LayerRays rays(rays_of(casting), std::make_shared<TriangleTree>(target), 5e-3, LayerRays::Grouping::together);
  const Pose X{exp_rotation({0.2, 0.1, 0.3}), {1e-3, 2e-3, -0.0185}};
  LayerRays::Memory memory;
  std::vector<int> visits(casting.triangles.size());
  for (const Met& m : cast(rays, X, memory)) ++visits[static_cast<std::size_t>(m.ray)];
  for (std::size_t k = 0; k < visits.size(); ++k) {
    const Ray& ray = rays.rays()[k];
    EXPECT_EQ(visits[k], test::leaving_by_all(target, X * ray.origin, X.R * ray.direction, 5e-3) ? 1 : 0);
  }
}

/// A ball with a hollow: what starts in the hollow, or outside, and passes through the wall is no overlap.
TEST(LayerRays, WhatEntersBeforeItLeavesIsNoOverlap) {
  Mesh target = test::ball(0.02, 3e-3);
  const Mesh hollow = test::ball(0.0175, 3e-3);
  const int first = static_cast<int>(target.vertices.size());
  target.vertices.insert(target.vertices.end(), hollow.vertices.begin(), hollow.vertices.end());
  for (const auto& t : hollow.triangles) target.triangles.push_back({t[0] + first, t[2] + first, t[1] + first});
  const Mesh casting = test::sheet(0.03, 20);
  const LayerRays rays(rays_of(casting), std::make_shared<TriangleTree>(target), 6e-3, LayerRays::Grouping::together);
  LayerRays::Memory memory;
  int overlaps = 0, through = 0;
  for (double z = -0.022; z < 0.022; z += 0.8e-3) {
    const Pose X{exp_rotation({0.1, 5 * z, 0.3}), {1e-3, 2e-3, z}};
    std::vector<int> visits(casting.triangles.size());
    for (const Met& m : cast(rays, X, memory)) ++visits[static_cast<std::size_t>(m.ray)];
    for (std::size_t k = 0; k < visits.size(); ++k) {
      const Vec3 origin = X * rays.rays()[k].origin, direction = X.R * rays.rays()[k].direction;
      const auto expected = test::overlap_by_all(target, origin, direction, 6e-3);
      ASSERT_EQ(visits[k], expected ? 1 : 0) << "ray " << k << " at " << z;
      overlaps += expected ? 1 : 0;
      through += !expected && test::leaving_by_all(target, origin, direction, 6e-3) ? 1 : 0;
    }
  }
  EXPECT_GT(overlaps, 1000);
  EXPECT_GT(through, 1000);
}

TEST(LayerRays, WhatTheirLeadEntersIsOverlap) {
  // A slab 2 mm thick: rays begin up to 6 mm before it, with a lead that ends within it or before.
  Mesh target = test::sheet(0.05, 12);
  const int first = static_cast<int>(target.vertices.size());
  const std::size_t upper = target.triangles.size();
  for (int v = 0; v < first; ++v) target.vertices.push_back(target.vertices[at(v)] - 2e-3 * Vec3::UnitZ());
  for (std::size_t t = 0; t < upper; ++t) {
    const auto c = target.triangles[t];
    target.triangles.push_back({c[0] + first, c[2] + first, c[1] + first});
  }
  const Mesh casting = test::sheet(0.03, 20);
  constexpr double kLead = 4e-3;
  const LayerRays rays(rays_of(casting), std::make_shared<TriangleTree>(target), 9e-3, LayerRays::Grouping::together,
                       {}, kLead);
  LayerRays::Memory memory;
  for (const double z : {1.5e-3, 3e-3, 3.9e-3, 4.1e-3, 5e-3, 6e-3}) {
    const auto met = cast(rays, {exp_rotation({0, 0, 0.2}), {1e-3, 2e-3, z}}, memory);
    EXPECT_EQ(met.size(), z < kLead ? casting.triangles.size() : 0) << z;
    for (const Met& m : met) EXPECT_NEAR(m.distance, z + 2e-3, 1e-12);
  }
}

/// The full search of the tree for every ray, in the order of the rays that were met.
void expect_full_search(const LayerRays& rays, const Pose& X_TC, const std::vector<Met>& met) {
  std::vector<TriangleTree::Hit> found(rays.rays().size());
  for (const Met& m : met) found[static_cast<std::size_t>(m.ray)] = {m.triangle, m.distance};
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Vec3 origin = X_TC * rays.rays()[k].origin, direction = X_TC.R * rays.rays()[k].direction;
    TriangleTree::Hit hit = rays.target().leaving(origin, direction, rays.length());
    if (hit && rays.target().entering(origin, direction, hit.distance)) hit = {};
    ASSERT_EQ(found[k].triangle, hit.triangle) << "ray " << k;
    ASSERT_EQ(found[k].distance, hit.distance) << "ray " << k;
  }
}

/// Poses as Newton's method and the search for events visit them: steps of a path, each with smaller ones about it,
/// some back to a pose of before.
void expect_full_search_along_a_path(const LayerRays& rays, Pose X, int steps) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0, 1);
  const auto moved = [&](double size) {
    Vec6 twist;
    for (int i = 0; i < 6; ++i) twist[i] = size * normal(random) * (i < 3 ? 1 : 30);
    return retract(X, twist);
  };
  LayerRays::Memory warm;
  std::size_t met = 0;
  for (int k = 0; k < steps; ++k) {
    X = moved(k % 10 == 9 ? 2e-3 : 3e-4);
    if (X.p.norm() > 0.03) X.p *= 0.5;
    for (const Pose& at : {X, moved(1e-5), moved(1e-8), moved(3e-4), X}) {
      const auto found = cast(rays, at, warm);
      expect_full_search(rays, at, found);
      if (testing::Test::HasFatalFailure()) return;
      met += found.size();
    }
  }
  EXPECT_GT(met, 500u);
}

TEST(LayerRays, IsTheFullSearchOnABall) {
  const LayerRays rays(rays_of(test::sheet(0.02, 25)), std::make_shared<TriangleTree>(test::ball(0.02, 1.5e-3)), 5e-3,
                       LayerRays::Grouping::together);
  expect_full_search_along_a_path(rays, {Mat3::Identity(), {0, 0, -0.019}}, 40);
}

/// Rays that begin now in a thin wall, now before it, and enter it then.
TEST(LayerRays, IsTheFullSearchOnAThinWall) {
  Mesh target = test::ball(0.02, 1.5e-3);
  const Mesh hollow = test::ball(0.0185, 1.5e-3);
  const int first = static_cast<int>(target.vertices.size());
  target.vertices.insert(target.vertices.end(), hollow.vertices.begin(), hollow.vertices.end());
  for (const auto& t : hollow.triangles) target.triangles.push_back({t[0] + first, t[2] + first, t[1] + first});
  const LayerRays rays(rays_of(test::sheet(0.01, 20)), std::make_shared<TriangleTree>(target), 6e-3,
                       LayerRays::Grouping::together);
  LayerRays::Memory warm;
  std::size_t least = rays.rays().size(), most = 0;
  for (int k = 0; k < 120; ++k) {
    const double phase = 0.15 * k;
    const Pose X{exp_rotation({0.05 * std::sin(phase / 3), 0.02, 0}), {0, 0, -0.0185 + 1.5e-3 * std::sin(phase)}};
    const auto found = cast(rays, X, warm);
    expect_full_search(rays, X, found);
    if (HasFatalFailure()) return;
    least = std::min(least, found.size());
    most = std::max(most, found.size());
  }
  EXPECT_GT(most, 3 * least);
}

/// A sheet with a rim, whose edges and corners the rays go through exactly, or miss by a rounding.
TEST(LayerRays, IsTheFullSearchAtEdges) {
  const Mesh target = test::sheet(8e-3, 16);
  std::vector<Ray> rays;
  for (int i = -18; i <= 18; ++i)
    for (int j = -18; j <= 18; ++j)
      for (const double off : {0.0, 1e-19, -1e-12, 2e-4})
        rays.push_back({{i * 0.5e-3 + off, j * 0.5e-3 - off, -1e-3}, Vec3::UnitZ()});
  const LayerRays above(rays, std::make_shared<TriangleTree>(target), 5e-3, LayerRays::Grouping::together);
  LayerRays::Memory warm;
  for (int k = 0; k < 30; ++k) {
    const Pose X{Mat3::Identity(), {0.25e-3 * k, 1e-13 * k, (k % 5 - 2) * 0.4e-3}};
    const auto found = cast(above, X, warm);
    EXPECT_EQ(found.empty(), false);
    expect_full_search(above, X, found);
    if (HasFatalFailure()) return;
  }
  expect_full_search_along_a_path(above, {}, 15);
}

TEST(LayerRays, AtAPoseOfBeforeTheyVisitTheSameInTheSameOrder) {
  const LayerRays rays(rays_of(test::sheet(0.02, 25)), std::make_shared<TriangleTree>(test::ball(0.02, 1.5e-3)), 5e-3,
                       LayerRays::Grouping::together);
  LayerRays::Memory memory;
  std::vector<std::vector<Met>> first;
  const auto pose = [](int k) { return Pose{exp_rotation({0.1, 0.02 * k, 0}), {2e-4 * k, 0, -0.0187}}; };
  for (int k = 0; k < 6; ++k) first.push_back(cast(rays, pose(k), memory));  // more than it keeps
  for (const int k : {5, 2, 4, 0, 3, 5, 1, 1}) {
    EXPECT_FALSE(first[static_cast<std::size_t>(k)].empty());
    EXPECT_EQ(cast(rays, pose(k), memory), first[static_cast<std::size_t>(k)]) << k;
  }
}

TEST(LayerRays, NoRays) {
  const LayerRays rays({}, std::make_shared<TriangleTree>(test::ball(0.02, 4e-3)), 5e-3, LayerRays::Grouping::together);
  LayerRays::Memory memory;
  EXPECT_TRUE(cast(rays, {}, memory).empty());
}

}  // namespace
}  // namespace genu
