// The choice of the fit radius: 3 edges without noise, wider with it, the same on every run.
#include "genu/surface/fit_choice.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "genu/core/pose.h"
#include "genu/surface/analytic.h"
#include "support/blend_torus.h"

namespace genu {
namespace {

FitChoice choose(const Mesh& mesh) { return choose_fit(mesh, vertex_graph(mesh), std::nullopt, std::nullopt); }

TEST(FitChoice, IsThreeEdgesWithoutNoise) {
  for (double edge : {2e-3, 1e-3, 0.5e-3, 0.25e-3}) {
    const Mesh torus = test::jittered_torus(15e-3, 5e-3, edge);
    const FitChoice choice = choose(torus);
    const double h = vertex_graph(torus).median_edge;
    std::printf("torus edge %.2f mm: fit radius %.3f h, noise seen %.2f um\n", 1e3 * edge, choice.radius / h,
                1e6 * choice.noise.rms);
    EXPECT_NEAR(choice.radius, 3 * h, 1e-12);
    EXPECT_EQ(choice.degree, 3);
  }
  const Mesh flat = test::jittered_patch(20e-3, 1e-3, [](double, double) { return 0.0; });
  EXPECT_NEAR(choose(flat).radius, 3 * vertex_graph(flat).median_edge, 1e-12);
}

TEST(FitChoice, GrowsWithTheCubeRootOfTheNoise) {
  // A bowl of radius 40 mm; 28 sigma h / rho^3 reaches 0.15 of its curvature at `expected`.
  double last = 0;
  for (double noise : {5e-6, 15e-6, 45e-6}) {
    std::mt19937 random(8);
    std::normal_distribution<double> normal;
    Mesh bowl = test::jittered_patch(30e-3, 0.8e-3, [](double x, double y) { return 12.5 * (x * x + y * y); });
    for (Vec3& v : bowl.vertices) v.z() += noise * normal(random);
    const FitChoice choice = choose(bowl);
    const double h = vertex_graph(bowl).median_edge, expected = std::cbrt(28 * noise * h / (0.15 * 25));
    std::printf("noise %.0f um: fit radius %.2f mm, expected %.2f mm, noise seen %.1f um (%s)\n", 1e6 * noise,
                1e3 * choice.radius, 1e3 * expected, 1e6 * choice.noise.rms, choice.why.c_str());
    EXPECT_GT(choice.radius, last);
    EXPECT_NEAR(choice.radius, std::max(expected, 3 * h), 0.3 * expected);
    EXPECT_NEAR(choice.noise.rms, noise, 0.15 * noise);
    last = choice.radius;
  }
}

/// The curvature of a blend against the exact one, rms over its nodes, 1/m.
double curvature_error(const Mesh& mesh, const Surface& exact, int degree) {
  BlendOptions options;
  options.degree = degree;
  const auto blend = test::build(mesh, options);
  double square = 0;
  int count = 0;
  for (const Vec3& x : blend->node_positions()) {
    SurfacePoint p, q;
    if (!blend->project(x, p) || !exact.project(p.p, q)) continue;
    square += (test::tensor(p) - test::tensor(q)).squaredNorm();
    ++count;
  }
  return std::sqrt(square / count);
}

TEST(FitChoice, UnderNoiseDegreeThreeIsNeverFarFromTheBest) {
  const auto torus = make_torus({}, 15e-3, 5e-3, false);
  for (const double edge : {0.8e-3, 1.6e-3})
    for (const double noise : {15e-6, 50e-6}) {
      const Mesh mesh = test::jittered_torus(15e-3, 5e-3, edge, noise);
      const double two = curvature_error(mesh, *torus, 2), three = curvature_error(mesh, *torus, 3),
                   four = curvature_error(mesh, *torus, 4);
      std::printf("edge %.1f mm, noise %.0f um: curvature errs by %.1f, %.1f, %.1f 1/m with degrees 2, 3, 4\n",
                  1e3 * edge, 1e6 * noise, two, three, four);
      EXPECT_LT(three, 1.6 * std::min(two, four));
      EXPECT_LT(three, std::max(two, four));
    }
}

TEST(FitChoice, TakesWhatIsGiven) {
  const Mesh torus = test::jittered_torus(15e-3, 5e-3, 1e-3);
  const FitChoice choice = choose_fit(torus, vertex_graph(torus), 4e-3, 2);
  EXPECT_EQ(choice.radius, 4e-3);
  EXPECT_EQ(choice.degree, 2);
  EXPECT_FALSE(choice.why.empty());
}

}  // namespace
}  // namespace genu
