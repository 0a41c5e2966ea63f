#include "genu/shape_fit/surface_fit.h"

#include <cmath>
#include <cstdio>
#include <random>

#include <gtest/gtest.h>

#include "genu/shape_fit/chart_choice.h"
#include "genu/surface/polynomial_surface.h"
#include "support/fitted_shapes.h"

namespace genu {
namespace {

SurfaceFit fitted(const Mesh& mesh, const SurfaceFitOptions& options = {}) {
  Diagnostics out;
  auto fit = fit_surface(mesh, options, "mesh", out);
  for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
  return fit ? std::move(*fit) : SurfaceFit{};
}

/// The largest change of a coefficient, as what it changes at the patch's corner (m).
double worst_change(const SurfaceFit& a, const SurfaceFit& b) {
  EXPECT_EQ(a.terms.size(), b.terms.size());
  double worst = 0;
  for (std::size_t k = 0; k < std::min(a.terms.size(), b.terms.size()); ++k)
    worst = std::max(worst, std::abs(a.terms[k].c - b.terms[k].c) * std::pow(a.patch.u1, a.terms[k].i) *
                                std::pow(a.patch.v1, a.terms[k].j));
  return worst;
}

Mesh mesh_of(const SurfaceFit& fit, double edge) {
  return chart_mesh(fit.chart, fit.patch, fit.terms, fit.inside, edge);
}

Mesh plateau(double edge) {
  return chart_mesh({false, test::some_frame()}, {-0.017, 0.017, -0.012, 0.012}, test::plateau_terms(), false, edge);
}

Mesh condyle(double edge, bool inside = false) {
  return chart_mesh({true, test::some_frame()}, {-1.3, 1.3, -0.011, 0.011}, test::condyle_terms(), inside, edge);
}

TEST(SurfaceFit, ChoosesTheChartAndFollowsTheSurface) {
  const SurfaceFit flat = fitted(plateau(0.7e-3)), round = fitted(condyle(0.7e-3));
  EXPECT_FALSE(flat.chart.cylindrical);
  EXPECT_TRUE(round.chart.cylindrical);
  EXPECT_FALSE(round.inside);
  std::printf("plateau: degree %d, rms %.1e m; condyle: degree %d, rms %.1e m\n", flat.degree, flat.residual.rms,
              round.degree, round.residual.rms);
  EXPECT_EQ(flat.degree, 4);
  EXPECT_EQ(round.degree, 4);
  EXPECT_LT(flat.residual.rms, 1e-15);
  EXPECT_LT(round.residual.rms, 1e-15);
  EXPECT_GT(flat.covered, 0.99);
  EXPECT_TRUE(fitted(condyle(0.7e-3, true)).inside);
}

/// Vertices off any polynomial, and a border that is no chart's.
Mesh as_segmented(Mesh mesh) {
  std::mt19937 random(11);
  std::normal_distribution<double> noise(0, 4e-5);
  for (Vec3& v : mesh.vertices) v += Vec3{noise(random), noise(random), noise(random)};
  return mesh;
}

TEST(SurfaceFit, UnaidedRoundTripKeepsTheCoefficients) {
  for (const Mesh& mesh : {plateau(0.7e-3), condyle(0.7e-3), condyle(0.7e-3, true)}) {
    const SurfaceFit first = fitted(as_segmented(mesh));
    EXPECT_GT(first.residual.rms, 1e-5);
    for (const double edge : {1.3e-3, 0.6e-3}) {
      const SurfaceFit again = fitted(mesh_of(first, edge));
      EXPECT_EQ(first.degree, again.degree);
      EXPECT_EQ(first.inside, again.inside);
      EXPECT_EQ(first.patch.u1, again.patch.u1);
      EXPECT_EQ(first.patch.v1, again.patch.v1);
      const double worst = worst_change(first, again);
      std::printf("degree %d, everything chosen again: coefficients change by %.1e m\n", first.degree, worst);
      EXPECT_LT(worst, 1e-12);
      EXPECT_LT(chart_difference(first.chart, again.chart, 0.01), 1e-12);
    }
  }
}

TEST(SurfaceFit, UnaidedAfterSinglePrecision) {
  for (const Mesh& mesh : {plateau(0.7e-3), condyle(0.7e-3)}) {
    const SurfaceFit first = fitted(as_segmented(mesh));
    Mesh rounded = mesh_of(first, 0.6e-3);
    for (Vec3& v : rounded.vertices)
      for (int k = 0; k < 3; ++k) v[k] = 1e-3 * static_cast<double>(static_cast<float>(1e3 * v[k]));
    const SurfaceFit again = fitted(rounded);
    EXPECT_EQ(first.degree, again.degree);
    const double worst = worst_change(first, again);
    std::printf("degree %d, single precision: coefficients change by %.1e m\n", first.degree, worst);
    EXPECT_LT(worst, 5e-8);
  }
}

TEST(SurfaceFit, RoundTripInAKnownChartKeepsTheCoefficients) {
  for (const Mesh& mesh : {plateau(0.7e-3), condyle(0.7e-3)}) {
    const SurfaceFit first = fitted(mesh);
    SurfaceFitOptions options;
    options.like = KnownPatch{first.chart, first.inside, first.patch, first.degree};
    const SurfaceFit again = fitted(mesh_of(first, 0.9e-3), options);
    const double worst = worst_change(first, again);
    std::printf("known chart, degree %d: coefficients change by %.1e m\n", first.degree, worst);
    EXPECT_LT(worst, 1e-12);
    EXPECT_LT(std::abs(again.residual.largest), 1e-12);
  }
}

TEST(SurfaceFit, AMovedMeshGivesTheSameShapeMoved) {
  const Pose move{exp_rotation(Vec3(-1.1, 0.5, 2.0)), Vec3(0.1, -0.3, 0.2)};
  for (const Mesh& mesh : {plateau(1e-3), condyle(1e-3)}) {
    Mesh moved = mesh;
    for (Vec3& v : moved.vertices) v = move * v;
    const SurfaceFit a = fitted(mesh), b = fitted(moved);
    EXPECT_EQ(a.degree, b.degree);
    EXPECT_NEAR(a.patch.width(), b.patch.width(), 1e-9);
    double worst = 0;
    for (const Vec3& v : mesh.vertices) {
      const ChartPoint c = a.chart.coordinates(v);
      if (!a.patch.contains(c.u, c.v)) continue;
      worst = std::max(worst, std::abs(*a.surface()->gap(v) - *b.surface()->gap(move * v)));
    }
    EXPECT_LT(worst, 2e-6);
  }
}

TEST(SurfaceFit, VerticesOnThePatchsEdgesCountWhereverTheMeshLies) {
  for (const Mesh& mesh : {plateau(0.7e-3), condyle(0.7e-3)})
    for (const double far : {0.0, 1e-3, 0.1, 100.0}) {
      Mesh moved = mesh;
      for (Vec3& v : moved.vertices) v += Vec3(far, 0, 0);
      EXPECT_EQ(fitted(moved).residual.count, static_cast<int>(mesh.vertices.size())) << far;
    }
}

TEST(SurfaceFit, NoiseIsAveragedOut) {
  Mesh noisy = plateau(0.7e-3);
  const SurfaceFit clean = fitted(noisy);
  test::add_noise(noisy, clean.chart.X_BS.R.col(2), 1e-4, 5);
  const SurfaceFit fit = fitted(noisy);
  double square = 0;
  int count = 0;
  for (const Vec3& v : mesh_of(clean, 1e-3).vertices) {
    const ChartPoint c = fit.chart.coordinates(v);
    if (!fit.patch.contains(c.u, c.v)) continue;
    square += std::pow(*fit.surface()->gap(v), 2);
    ++count;
  }
  const double rms = std::sqrt(square / count);
  std::printf("0.1 mm of noise: degree %d, residual %.3f mm, off the true surface by %.4f mm\n", fit.degree,
              1e3 * fit.residual.rms, 1e3 * rms);
  EXPECT_NEAR(fit.residual.rms, 1e-4, 1e-5);
  EXPECT_LT(rms, 3e-5);
}

TEST(SurfaceFit, ThePatchHoldsTheContactsWithTheirMargin) {
  const Mesh mesh = condyle(0.8e-3);
  SurfaceFitOptions options;
  options.axis = test::some_frame().R.col(2);
  options.margin = 0.004;
  const SurfaceChart chart{true, test::some_frame()};
  const Polynomial P(test::condyle_terms());
  for (int k = 0; k <= 20; ++k) {
    const double u = -0.6 + 0.05 * k, v = 0.003 * std::sin(k);
    options.keep.push_back(chart.position({u, v, P.value(u, v)}));
  }
  const SurfaceFit fit = fitted(mesh, options);
  double least = 1;
  for (const Vec3& p : options.keep) {
    const ChartPoint c = fit.chart.coordinates(p);
    least = std::min(
        {least, (c.u - fit.patch.u0) * c.h, (fit.patch.u1 - c.u) * c.h, c.v - fit.patch.v0, fit.patch.v1 - c.v});
  }
  EXPECT_GT(least, 0.0035);
  EXPECT_LT(fit.patch.height(), 0.0145);
}

TEST(SurfaceFit, WhatCannotBeFittedIsSaid) {
  const auto refused = [](const Mesh& mesh, const SurfaceFitOptions& options = {}) {
    Diagnostics out;
    EXPECT_FALSE(fit_surface(mesh, options, "mesh", out));
    return out.items().empty() ? std::string() : out.items().front().rule;
  };
  EXPECT_NE(refused({}).find("no surface"), std::string::npos);
  const Mesh flat = chart_mesh({false, test::some_frame()}, {-0.01, 0.01, -0.01, 0.01}, {{0, 0, 0}}, false, 1e-3);
  EXPECT_NE(refused(flat).find("flat"), std::string::npos);
  SurfaceFitOptions high;
  high.degree = 12;
  EXPECT_NE(refused(plateau(4e-3), high).find("too few"), std::string::npos);
  Mesh both = plateau(1e-3), back = both;  // a shell 1 mm thick
  const int n = static_cast<int>(both.vertices.size());
  for (const Vec3& v : back.vertices) both.vertices.push_back(v - 1e-3 * test::some_frame().R.col(2));
  for (const auto& t : back.triangles) both.triangles.push_back({t[0] + n, t[2] + n, t[1] + n});
  EXPECT_FALSE(refused(both).empty());
}

}  // namespace
}  // namespace genu
