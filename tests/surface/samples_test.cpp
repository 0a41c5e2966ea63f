// Samples against closed forms and against plain searches over all pairs.
#include "genu/surface/samples.h"

#include <algorithm>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include "support/blend_meshes.h"

namespace genu {
namespace {

std::set<std::pair<int, int>> links(const SampleSet& set) {
  std::set<std::pair<int, int>> out;
  for (int i = 0; i < set.size(); ++i)
    for (int k = set.first_neighbour[static_cast<std::size_t>(i)];
         k < set.first_neighbour[static_cast<std::size_t>(i) + 1]; ++k)
      out.emplace(i, set.neighbours[static_cast<std::size_t>(k)]);
  return out;
}

double sum(const std::vector<double>& x) { return std::accumulate(x.begin(), x.end(), 0.0); }

void expect_symmetric(const std::set<std::pair<int, int>>& all) {
  for (const auto& [i, j] : all) {
    EXPECT_NE(i, j);
    EXPECT_TRUE(all.count({j, i})) << i << " " << j;
  }
}

TEST(VertexSamples, ShareOutTheWholeArea) {
  // A flat square patch is as large as its sides say, however it is cut.
  const auto flat = [](double, double) { return 0.0; };
  const SampleSet patch = vertex_samples(test::jittered_patch(0.01, 1e-3, flat));
  EXPECT_NEAR(sum(patch.areas), 4e-4, 1e-17);
  for (const Vec3& n : patch.normals) EXPECT_LT((n - Vec3::UnitZ()).norm(), 1e-14);
  const double sphere = 4 * M_PI * 4e-4;
  EXPECT_NEAR(sum(vertex_samples(test::noisy_sphere(0.02, 4, 0)).areas), sphere, 3e-3 * sphere);
}

TEST(VertexSamples, NeighboursAreTheEdges) {
  const auto flat = [](double, double) { return 0.0; };
  const Mesh mesh = test::jittered_patch(0.01, 2e-3, flat);
  std::set<std::pair<int, int>> edges;
  for (const auto& t : mesh.triangles)
    for (const auto& [a, b] : {std::pair{t[0], t[1]}, {t[1], t[2]}, {t[2], t[0]}}) {
      edges.emplace(a, b);
      edges.emplace(b, a);
    }
  const SampleSet set = vertex_samples(mesh);
  EXPECT_EQ(links(set), edges);
  EXPECT_EQ(set.neighbours.size(), edges.size());  // each once
}

TEST(ThinSamples, KeepTheirDistanceCoverAndShareOutTheArea) {
  constexpr double kSpacing = 2.5e-3, kSameSide = 0.3;
  const SampleSet fine = vertex_samples(test::jittered_torus(0.015, 0.005, 0.8e-3));
  const SampleSet thin = thin_samples(fine, kSpacing);
  ASSERT_LT(thin.size(), fine.size() / 3);
  ASSERT_GT(thin.size(), 100);
  EXPECT_NEAR(sum(thin.areas), sum(fine.areas), 1e-12 * sum(fine.areas));
  std::set<std::pair<int, int>> near;
  double closest = 1, farthest = 0;
  for (std::size_t i = 0; i < thin.points.size(); ++i)
    for (std::size_t j = 0; j < thin.points.size(); ++j) {
      if (i == j || thin.normals[i].dot(thin.normals[j]) <= kSameSide) continue;
      const double d = (thin.points[i] - thin.points[j]).norm();
      closest = std::min(closest, d);
      if (d < 2 * kSpacing) near.emplace(static_cast<int>(i), static_cast<int>(j));
    }
  for (std::size_t i = 0; i < fine.points.size(); ++i) {
    double least = 1;
    for (std::size_t j = 0; j < thin.points.size(); ++j)
      if (fine.normals[i].dot(thin.normals[j]) > kSameSide)
        least = std::min(least, (fine.points[i] - thin.points[j]).norm());
    farthest = std::max(farthest, least);
  }
  EXPECT_GE(closest, kSpacing);
  EXPECT_LE(farthest, kSpacing);
  expect_symmetric(links(thin));
  EXPECT_EQ(links(thin), near);
}

}  // namespace
}  // namespace genu
