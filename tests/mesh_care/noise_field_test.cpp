// The random field has the rms and the correlation that were asked for, belongs to space, and is the same on every run.
#include "genu/mesh_care/noise_field.h"

#include <cstdio>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "genu/mesh/vertex_graph.h"
#include "support/blend_meshes.h"

namespace genu {
namespace {

std::vector<Vec3> flat_points(double half, double edge) {
  return test::jittered_patch(half, edge, [](double, double) { return 0.0; }).vertices;
}

TEST(NoiseField, HasItsRmsAndCorrelation) {
  const MeshNoise noise{20e-6, 2e-3};
  constexpr int kSeeds = 40;
  const std::vector<Vec3> points = flat_points(20e-3, 1e-3);
  double square = 0, mean = 0;
  std::array<double, 5> product{}, count{};  // at distances of about 0, 1, 2, 3, 4 mm
  for (int seed = 0; seed < kSeeds; ++seed) {
    const std::vector<double> h = noise_field(points, noise, static_cast<std::uint64_t>(seed));
    for (std::size_t i = 0; i < h.size(); ++i) {
      square += h[i] * h[i];
      mean += h[i];
      for (std::size_t j = i; j < std::min(h.size(), i + 5); ++j) {
        const double r = (points[i] - points[j]).norm();
        const std::size_t bin = j - i;
        if (r > 4.6e-3) continue;  // the next row of the patch
        product[bin] += h[i] * h[j] / std::exp(-r * r / 4e-6);
        count[bin] += 1;
      }
    }
  }
  const double n = kSeeds * static_cast<double>(points.size());
  std::printf("rms %.2f um of 20, mean %.2f um; measured / asked covariance at 1, 2 mm: %.3f %.3f\n",
              1e6 * std::sqrt(square / n), 1e6 * mean / n, product[1] / count[1] / (noise.rms * noise.rms),
              product[2] / count[2] / (noise.rms * noise.rms));
  EXPECT_NEAR(std::sqrt(square / n), noise.rms, 0.03 * noise.rms);
  EXPECT_NEAR(mean / n, 0, 0.06 * noise.rms);  // of about 5000 independent patches
  EXPECT_NEAR(product[1] / count[1], noise.rms * noise.rms, 0.05 * noise.rms * noise.rms);
  EXPECT_NEAR(product[2] / count[2], noise.rms * noise.rms, 0.15 * noise.rms * noise.rms);
}

TEST(NoiseField, WhiteNoiseOfNeighboursIsIndependent) {
  const std::vector<double> h = noise_field(flat_points(50e-3, 1e-3), {20e-6, 0}, 3);
  double square = 0, product = 0;
  for (std::size_t i = 0; i + 1 < h.size(); ++i) square += h[i] * h[i], product += h[i] * h[i + 1];
  const double n = static_cast<double>(h.size());
  EXPECT_NEAR(std::sqrt(square / n), 20e-6, 0.4e-6);
  EXPECT_NEAR(product / square, 0, 0.04);
}

TEST(NoiseField, BelongsToSpaceAndSeed) {
  const MeshNoise noise{10e-6, 3e-3};
  std::vector<Vec3> points = flat_points(5e-3, 1e-3);
  const std::vector<double> first = noise_field(points, noise, 1);
  EXPECT_NE(first, noise_field(points, noise, 2));
  std::reverse(points.begin(), points.end());
  std::vector<double> turned;
  {
    tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
    turned = noise_field(points, noise, 1);
  }
  std::reverse(turned.begin(), turned.end());
  EXPECT_EQ(first, turned);
}

TEST(NoiseField, MovesVerticesAlongTheirNormals) {
  const Mesh torus = test::jittered_torus(15e-3, 5e-3, 1e-3);
  const Mesh moved = perturbed(torus, {10e-6, 2e-3}, 7);
  const VertexGraph graph = vertex_graph(torus);
  double sum = 0;
  for (std::size_t v = 0; v < torus.vertices.size(); ++v) {
    const Vec3 d = moved.vertices[v] - torus.vertices[v];
    EXPECT_LT(d.cross(graph.normals[v]).norm(), 1e-17);
    sum += d.squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(sum / static_cast<double>(torus.vertices.size())), 10e-6, 2e-6);
  EXPECT_EQ(moved.triangles, torus.triangles);
  EXPECT_EQ(perturbed(torus, {0, 2e-3}, 7).vertices, torus.vertices);
}

}  // namespace
}  // namespace genu
