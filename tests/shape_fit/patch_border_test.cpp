#include "genu/shape_fit/patch_border.h"

#include <cmath>
#include <cstdio>
#include <numbers>

#include <gtest/gtest.h>

#include "genu/mesh/mesh_part.h"
#include "genu/shape_fit/chart_choice.h"
#include "genu/shape_fit/polynomial_fit.h"
#include "genu/surface/analytic.h"
#include "genu/surface/polynomial_surface.h"
#include "support/fitted_shapes.h"

namespace genu {
namespace {

/// As a binary STL in mm would keep it.
Mesh in_single_precision(Mesh mesh) {
  for (Vec3& v : mesh.vertices)
    for (int k = 0; k < 3; ++k) v[k] = 1e-3 * static_cast<double>(static_cast<float>(1e3 * v[k]));
  return mesh;
}

/// How far the points of a mesh have other coordinates in two charts (m), which are centred on the same place.
double apart(const Mesh& mesh, const SurfaceChart& a, const SurfaceChart& b) {
  double worst = 0;
  for (const Vec3& p : mesh.vertices) worst = std::max(worst, (a.to_own(p) - b.to_own(p)).cwiseAbs().maxCoeff());
  return worst;
}

TEST(PatchBorder, GivesTheAxisBackWhateverTheTurn) {
  for (const double half : {0.5, 1.2, 0.5 * std::numbers::pi, 1.6, 2.4})
    for (const double middle : {0.0, 0.3}) {
      SurfaceChart chart{true, test::some_frame()};
      ChartBox box{middle - half, middle + half, -0.009, 0.012};
      const Mesh exact = chart_mesh(chart, box, test::condyle_terms(), half > 1, 0.8e-3);
      centre_on(box, chart);
      const Vec3 x = chart.X_BS.R.col(0), z = largest_positive(chart.X_BS.R.col(2));
      chart.X_BS.R << x, z.cross(x), z;
      const auto found = chart_of_border(exact), rounded = chart_of_border(in_single_precision(exact));
      ASSERT_TRUE(found && rounded) << half;
      ASSERT_TRUE(found->chart.cylindrical);
      const double off = apart(exact, found->chart, chart), off_rounded = apart(exact, rounded->chart, chart);
      std::printf("%.0f deg: chart off by %.1e m, in single precision by %.1e m\n", 360 / std::numbers::pi * half, off,
                  off_rounded);
      EXPECT_LT(off, 1e-14);
      EXPECT_LT(off_rounded, 2e-8);
      EXPECT_NEAR(found->patch.u1, half, 1e-12);
      EXPECT_EQ(found->patch.v1, 0.0105);  // a round number
    }
}

TEST(PatchBorder, GivesAPlaneBack) {
  const SurfaceChart chart{false, test::some_frame()};
  for (const bool tall : {false, true}) {
    const ChartBox box = tall ? ChartBox{-0.012, 0.012, -0.017, 0.017} : ChartBox{-0.017, 0.017, -0.012, 0.012};
    const Mesh mesh = chart_mesh(chart, box, test::plateau_terms(), false, 0.8e-3);
    const auto found = chart_of_border(mesh), rounded = chart_of_border(in_single_precision(mesh));
    ASSERT_TRUE(found && rounded);
    ASSERT_FALSE(found->chart.cylindrical);
    EXPECT_LT((found->chart.X_BS.R.col(2) - chart.X_BS.R.col(2)).norm(), 1e-13);
    EXPECT_LT((rounded->chart.X_BS.R.col(2) - chart.X_BS.R.col(2)).norm(), 1e-6);
    EXPECT_NEAR(std::abs(found->chart.X_BS.R.col(0).dot(chart.X_BS.R.col(tall ? 1 : 0))), 1, 1e-14);
    EXPECT_LT(chart.to_own(found->chart.X_BS.p).head<2>().norm(), 1e-15);
    EXPECT_EQ(found->patch.u1, 0.017);
    EXPECT_EQ(found->patch.v1, 0.012);
  }
}

TEST(PatchBorder, OtherBordersHaveNone) {
  const SurfaceChart chart{true, test::some_frame()};
  const Mesh patch = chart_mesh(chart, {-1.2, 1.2, -0.01, 0.01}, test::condyle_terms(), false, 0.8e-3);
  ASSERT_TRUE(chart_of_border(patch));
  Mesh nudged = patch;  // one vertex of the border, by a tenth of a micrometre
  for (Vec3& v : nudged.vertices) {
    if (chart.coordinates(v).v < 0.01 - 1e-9) continue;
    v += 1e-7 * chart.X_BS.R.col(2);
    break;
  }
  EXPECT_FALSE(chart_of_border(nudged));
  const auto across = [&](const Vec3& p, const Vec3&) {
    return chart.coordinates(p).u + 30 * chart.coordinates(p).v < 1;
  };
  EXPECT_FALSE(chart_of_border(part_of(patch, across)));
  EXPECT_FALSE(chart_of_border(make_sphere({}, 0.02, false)->triangles(1e-3, Vec3::Zero(), 0.05)));
  EXPECT_FALSE(chart_of_border(make_plane({}, false)->triangles(1e-3, Vec3::Zero(), 0.02)));
  EXPECT_FALSE(chart_of_border({}));
}

/// Why the border: what a wrong axis leaves over, once terms of a degree have taken up what they can.
TEST(PatchBorder, TheSurfaceInsideHardlyTellsItsAxis) {
  const SurfaceChart truth{true, test::some_frame()};
  const ChartBox box{-1.2, 1.2, -0.01, 0.01};
  const Mesh mesh = chart_mesh(truth, box, test::condyle_terms(), false, 0.8e-3);
  const auto left = [&](const Vec3& shift, const Vec3& tilt, int degree) {
    const SurfaceChart moved{true, truth.X_BS * Pose{exp_rotation(tilt), shift}};
    std::vector<HeightSample> samples;
    for (const Vec3& p : mesh.vertices) {
      const ChartPoint c = moved.coordinates(p);
      samples.push_back({c.u, c.v, c.h, 1});
    }
    return PolynomialFit(samples, box.grown(0.1, 0.001), degree).rms(degree);
  };
  for (const int degree : {4, 6, 8, 10})
    std::printf("degree %2d: 0.1 mm along x leaves %.0e m, along y %.0e m; 1 deg about x %.0e m, about y %.0e m\n",
                degree, left(Vec3(1e-4, 0, 0), Vec3::Zero(), degree), left(Vec3(0, 1e-4, 0), Vec3::Zero(), degree),
                left(Vec3::Zero(), Vec3(0.0175, 0, 0), degree), left(Vec3::Zero(), Vec3(0, 0.0175, 0), degree));
  // Single precision moves vertices by 2e-9 m.
  EXPECT_LT(left(Vec3(1e-4, 0, 0), Vec3::Zero(), 8), 2e-9);
  EXPECT_GT(left(Vec3(1e-4, 0, 0), Vec3::Zero(), 4), 2e-9);
}

}  // namespace
}  // namespace genu
