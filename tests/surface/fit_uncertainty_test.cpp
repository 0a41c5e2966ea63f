// The predicted effect of noise against the scatter of blends of perturbed meshes.
#include "genu/surface/fit_uncertainty.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "genu/mesh_care/noise_field.h"
#include "support/blend_torus.h"

namespace genu::test {
namespace {

struct FittedMesh {
  const char* name;
  Mesh mesh;
  double radius;     ///< m
  double keep_from;  ///< m: points nearer to an edge are left out
};

/// Rms differences of the blend of a perturbed mesh from the blend of the mesh itself, at the latter's nodes.
FitUncertainty scatter(const FittedMesh& c, int degree, const MeshNoise& noise, int seeds) {
  const auto exact = build(c.mesh, fitted(c.radius, degree));
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto noisy = build(perturbed(c.mesh, noise, static_cast<std::uint64_t>(seed)), fitted(c.radius, degree));
    for (const Vec3& x : exact->node_positions()) {
      SurfacePoint a, b;
      if (exact->edge_distance(x) < c.keep_from) continue;
      EXPECT_TRUE(exact->project(x, a));
      if (!noisy->project(Vec3(a.p), b)) continue;
      sum += Vec3((b.p - a.p).squaredNorm(), (b.n - a.n).squaredNorm() / 2, 0);
      const Mat3 dS = tensor(b) - tensor(a);
      for (int k = 0; k < 2; ++k) sum[2] += std::pow(a.T.col(k).dot(dS * a.T.col(k)), 2) / 2;
      ++count;
    }
  }
  const Vec3 rms = (sum / count).cwiseSqrt();
  return {rms[0], rms[1], rms[2]};
}

std::vector<FittedMesh> fitted_meshes() {
  return {{"flat", jittered_patch(20e-3, 1e-3, [](double, double) { return 0.0; }), 4e-3, 4e-3},
          {"bowl", jittered_patch(20e-3, 1e-3, [](double x, double y) { return 12.5 * (x * x + y * y); }), 5e-3, 5e-3},
          {"torus", jittered_torus(30e-3, 12e-3, 1.5e-3), 5e-3, 0}};
}

TEST(FitUncertainty, AgreesWithTheScatterOfPerturbedMeshes) {
  constexpr double kFactor = 1.4;
  double worst = 1;
  for (const FittedMesh& c : fitted_meshes()) {
    for (int degree : {2, 3, 4}) {
      for (double length : {0.0, 1e-3, 2e-3, 4e-3}) {
        const MeshNoise noise{5e-6, length};
        const double edge = vertex_graph(c.mesh).median_edge;
        const FitUncertainty found = scatter(c, degree, noise, 2),
                             said = fit_uncertainty(noise, edge, c.radius, degree);
        std::printf("%s, degree %d, 5 um over %.0f mm: scatter / predicted: height %.2f, slope %.2f, curvature %.2f\n",
                    c.name, degree, 1e3 * length, found.height / said.height, found.slope / said.slope,
                    found.curvature / said.curvature);
        for (double ratio : {found.height / said.height, found.slope / said.slope, found.curvature / said.curvature}) {
          EXPECT_GT(ratio, 1 / kFactor);
          EXPECT_LT(ratio, kFactor);
          worst = std::max({worst, ratio, 1 / ratio});
        }
      }
    }
  }
  std::printf("worst factor %.2f\n", worst);
}

TEST(FitUncertainty, FollowsFromOneNoisyMeshToAFactorOfTwo) {
  for (const FittedMesh& c : fitted_meshes()) {
    for (double length : {0.0, 1e-3, 2e-3, 4e-3}) {
      const MeshNoise noise{20e-6, length};
      const Mesh noisy = perturbed(c.mesh, noise, 11);
      const VertexGraph graph = vertex_graph(noisy);
      const FitUncertainty said = fit_uncertainty(estimate_noise(noisy, graph), graph.median_edge, c.radius, 3);
      const FitUncertainty found = scatter(c, 3, noise, 2);
      const double ratio = found.curvature / said.curvature, slope = found.slope / said.slope;
      std::printf("%s, 20 um over %.0f mm: scatter / predicted from one noisy mesh: slope %.2f, curvature %.2f\n",
                  c.name, 1e3 * length, slope, ratio);
      EXPECT_GT(ratio, 0.5) << c.name << length;
      EXPECT_LT(ratio, 2) << c.name << length;
      EXPECT_GT(slope, 0.5) << c.name << length;
      EXPECT_LT(slope, 2) << c.name << length;
    }
  }
}

TEST(FitUncertainty, FollowsItsLaws) {
  const FitUncertainty once = fit_uncertainty({1e-6, 0}, 1e-3, 5e-3, 3);
  std::printf("white noise: curvature = c sigma h / rho^3 with c =");
  for (int degree : {2, 3, 4})
    std::printf(" %.1f", fit_uncertainty({1e-6, 0}, 1e-3, 5e-3, degree).curvature * std::pow(5e-3, 3) / 1e-9);
  std::printf("\n");
  EXPECT_NEAR(fit_uncertainty({2e-6, 0}, 1e-3, 5e-3, 3).curvature, 2 * once.curvature, 1e-9 * once.curvature);
  EXPECT_NEAR(fit_uncertainty({1e-6, 0}, 2e-3, 5e-3, 3).curvature, 2 * once.curvature, 1e-9 * once.curvature);
  EXPECT_NEAR(fit_uncertainty({1e-6, 0}, 1e-3, 10e-3, 3).curvature, once.curvature / 8, 1e-9 * once.curvature);
  // Noise over much more than the fit radius moves the fit as a whole.
  const FitUncertainty wide = fit_uncertainty({1e-6, 100e-3}, 1e-3, 5e-3, 3);
  EXPECT_NEAR(wide.height, 1e-6, 1e-9);
  // The field's own derivatives: from the correlation's at 0, of order 2 and 4.
  EXPECT_NEAR(wide.slope, std::sqrt(2.0) * 1e-6 / 100e-3, 1e-2 * wide.slope);
  EXPECT_NEAR(wide.curvature, std::sqrt(12.0) * 1e-6 / 1e-2, 1e-2 * wide.curvature);
}

}  // namespace
}  // namespace genu::test
