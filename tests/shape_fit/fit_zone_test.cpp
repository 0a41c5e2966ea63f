#include "genu/shape_fit/fit_zone.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/mesh/mesh_part.h"
#include "genu/shape_fit/chart_choice.h"
#include "genu/surface/analytic.h"
#include "support/fitted_shapes.h"

namespace genu {
namespace {

/// A drum with a notch over half of its turn: two arms and what joins them, about some axis.
Mesh forked() {
  const SurfaceChart chart{true, test::some_frame()};
  const Mesh drum = chart_mesh(chart, {-2, 2, -0.03, 0.03}, {{0, 0, 0.02}}, false, 0.8e-3);
  return part_of(drum, [&](const Vec3& p, const Vec3&) {
    const ChartPoint c = chart.coordinates(p);
    return c.u > 0 || std::abs(c.v) > 0.007;
  });
}

TEST(FitZone, AForkHasTwoArms) {
  const auto arms = arms_of(forked());
  ASSERT_EQ(arms.size(), 2u);
  const SurfaceChart chart{true, test::some_frame()};
  for (const Zone& arm : arms) {
    EXPECT_NEAR(area_of(arm.mesh), 2 * 0.02 * 0.023, 0.15 * 2 * 0.02 * 0.023);
    EXPECT_GT(std::abs(arm.axis->dot(test::some_frame().R.col(2))), 0.999);
    for (const Vec3& p : arm.mesh.vertices) EXPECT_GT(std::abs(chart.coordinates(p).v), 0.0065);
  }
  const Mesh whole = chart_mesh(chart, {-2, 2, -0.03, 0.03}, {{0, 0, 0.02}}, false, 1e-3);
  EXPECT_TRUE(arms_of(whole).empty());
}

TEST(FitZone, OpenSheetsAreSurfacesAndClosedOnesAmbiguous) {
  Mesh two = chart_mesh({false, {}}, {0.04, 0.06, -0.01, 0.01}, {{2, 0, 3}}, false, 1e-3);
  const Mesh other = chart_mesh({false, {}}, {-0.06, -0.03, -0.01, 0.01}, {{2, 0, 3}}, false, 1e-3);
  const int n = static_cast<int>(two.vertices.size());
  two.vertices.insert(two.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& t : other.triangles) two.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  Diagnostics out;
  const auto zones = find_zones(two, {}, "two", out);
  ASSERT_EQ(zones.size(), 2u);
  EXPECT_LT(zones[0].mesh.vertices[0].x(), zones[1].mesh.vertices[0].x());  // by place, not by size
  EXPECT_FALSE(out.has_errors());

  const Mesh ball = make_sphere({}, 0.02, false)->triangles(1e-3, Vec3::Zero(), 0.05);
  EXPECT_TRUE(find_zones(ball, {}, "ball", out).empty());
  EXPECT_EQ(out.count(Diagnostic::Severity::error), 1u);
  ZoneOptions up;
  up.facing = Vec3(0, 0, 2);
  Diagnostics good;
  const auto cap = find_zones(ball, up, "ball", good);
  ASSERT_EQ(cap.size(), 1u);
  for (const Vec3& p : cap[0].mesh.vertices) EXPECT_GT(p.z(), 0);
  ZoneOptions nowhere;
  nowhere.within = [](const Vec3&) { return false; };
  EXPECT_TRUE(find_zones(ball, nowhere, "ball", good).empty());
  EXPECT_TRUE(good.has_errors());
}

TEST(FitZone, RoundAPathOnOneFaceOfAShell) {
  Mesh shell = chart_mesh({false, {}}, {-0.03, 0.03, -0.02, 0.02}, {{0, 0, 0}}, false, 1e-3), back = shell;
  const int n = static_cast<int>(shell.vertices.size());
  for (const Vec3& v : back.vertices) shell.vertices.push_back(v - Vec3(0, 0, 0.002));
  for (const auto& t : back.triangles) shell.triangles.push_back({t[0] + n, t[2] + n, t[1] + n});
  const std::vector<Vec3> points{{0, 0, 0}, {0.005, 0, 0}}, normals(2, Vec3::UnitZ());
  const Mesh zone = zone_round(shell, points, normals, 0.006);
  ASSERT_FALSE(zone.empty());
  for (const Vec3& p : zone.vertices) {
    EXPECT_EQ(p.z(), 0);
    EXPECT_LT(std::min(p.norm(), (p - points[1]).norm()), 0.0075);
  }
  EXPECT_TRUE(zone_round(shell, {Vec3(1, 0, 0)}, {Vec3::UnitZ()}, 0.006).empty());
}

}  // namespace
}  // namespace genu
