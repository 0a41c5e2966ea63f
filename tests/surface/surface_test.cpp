// What every surface has from the start: tangent bases, the default retraction, samples.
#include "genu/surface/surface.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "genu/surface/analytic.h"

namespace genu {
namespace {

TEST(TangentBasis, IsOrthonormalRightHandedAndSmoothOnEachHalf) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return Vec3{normal(random), normal(random), normal(random)}; };
  double worst = 0, steepest = 0;
  for (int k = 0; k < 20000; ++k) {
    const Vec3 n = draw().normalized(), near = (n + 1e-6 * draw()).normalized();
    const Mat32 T = tangent_basis(n);
    Mat3 all;
    all << T, n;
    worst = std::max({worst, (all.transpose() * all - Mat3::Identity()).norm(), (T.col(0).cross(T.col(1)) - n).norm()});
    if (std::signbit(n.z()) == std::signbit(near.z()))  // the basis switches where z changes sign, and nowhere else
      steepest = std::max(steepest, (tangent_basis(near) - T).norm() / (near - n).norm());
  }
  EXPECT_LT(worst, 1e-15 * 5);
  EXPECT_LT(steepest, 3);
  for (const double z : {1.0, -1.0})
    EXPECT_EQ(tangent_basis({0, 0, z}).col(0).cross(tangent_basis({0, 0, z}).col(1)).z(), z);
}

/// A torus that has nothing but the defaults and notes where it was asked to project.
struct Plain final : Surface {
  std::unique_ptr<Surface> torus = make_torus({}, 0.015, 0.005, false);
  mutable Vec3 asked = Vec3::Zero();

  bool project(const Vec3& x, SurfacePoint& out) const override {
    asked = x;
    return torus->project(x, out);
  }
  std::optional<double> gap(const Vec3& x) const override { return torus->gap(x); }
  Mesh triangles(double edge, const Vec3& centre, double reach) const override {
    return torus->triangles(edge, centre, reach);
  }
};

TEST(DefaultRetract, IsOfSecondOrder) {
  const Plain surface;
  std::mt19937 random(9);
  std::uniform_real_distribution<double> angle(0, 2 * M_PI);
  double worst_off[2] = {0, 0}, worst_bend[2] = {0, 0};
  for (int k = 0; k < 50; ++k) {
    const double u = angle(random), v = angle(random), w = angle(random);
    const Vec3 radial(std::cos(u), std::sin(u), 0);
    SurfacePoint from;
    ASSERT_TRUE(surface.project(0.015 * radial + 0.006 * (std::cos(v) * radial + std::sin(v) * Vec3::UnitZ()), from));
    double off[2], bend[2];  // of a step and of half of it
    for (int i = 0; i < 2; ++i) {
      const Vec2 ds = (i == 0 ? 4e-4 : 2e-4) * Vec2(std::cos(w), std::sin(w));
      SurfacePoint there, back;
      ASSERT_TRUE(surface.retract(from, ds, there));
      off[i] = std::abs(*surface.gap(surface.asked));
      EXPECT_LT(std::abs(*surface.gap(there.p)), 1e-16);
      ASSERT_TRUE(surface.retract(from, -ds, back));
      EXPECT_LT((there.p - back.p - 2 * from.T * ds).norm(), 20 * std::pow(ds.norm(), 3) / (0.005 * 0.005));
      bend[i] = (there.p + back.p - 2 * from.p - ds.dot(from.S * ds) * from.n).norm();
    }
    // The expansion misses the surface by the cube of the step: without its curvature, by the square.
    EXPECT_LT(off[0], 2 * std::pow(4e-4, 3) / (0.005 * 0.005));
    for (int i = 0; i < 2; ++i)
      worst_off[i] = std::max(worst_off[i], off[i]), worst_bend[i] = std::max(worst_bend[i], bend[i]);
    EXPECT_LT(bend[0], 2 * std::pow(4e-4, 3) / (0.005 * 0.005));
  }
  // One sample may sit where the cubic term vanishes: the worst of all of them falls with the cube.
  EXPECT_LT(worst_off[1], worst_off[0] / 5);
  EXPECT_LT(worst_bend[1], worst_bend[0] / 5);
}

TEST(SurfaceDefaults, HaveNoEdgeAndSampleTheirTriangles) {
  const Plain surface;
  EXPECT_EQ(surface.edge_distance({0.02, 0, 0}), INFINITY);
  const Mesh mesh = surface.triangles(1e-3, Vec3::Zero(), 0.1);
  const SampleSet set = surface.samples(1e-3, Vec3::Zero(), 0.1);
  ASSERT_GT(set.size(), 1000);
  EXPECT_TRUE(set.points == mesh.vertices);
  double area = 0;
  for (const double a : set.areas) area += a;
  const double exact = 4 * M_PI * M_PI * 0.015 * 0.005;
  EXPECT_NEAR(area, exact, 0.01 * exact);
}

/// Where the geodesic ends that begins as T ds, |ds| long: p'' = (p' . S p') n, by small steps of order 4 (Runge and
/// Kutta) that are put back onto the surface.
Vec3 geodesic_end(const Surface& surface, const SurfacePoint& from, const Vec2& ds) {
  constexpr int kSteps = 50;
  const double h = ds.norm() / kSteps;
  Vec3 p = from.p, v = from.T * ds.normalized();
  const auto bend = [&](const Vec3& x, const Vec3& along) -> Vec3 {
    SurfacePoint at;
    EXPECT_TRUE(surface.project(x, at));
    const Vec2 w = at.T.transpose() * along;
    return w.dot(at.S * w) * at.n;
  };
  for (int k = 0; k < kSteps; ++k) {
    const Vec3 a1 = bend(p, v), a2 = bend(p + h / 2 * v, v + h / 2 * a1);
    const Vec3 a3 = bend(p + h / 2 * v + h * h / 4 * a1, v + h / 2 * a2);
    const Vec3 a4 = bend(p + h * v + h * h / 2 * a2, v + h * a3);
    p += h * v + h * h / 6 * (a1 + a2 + a3);
    v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    SurfacePoint back;
    EXPECT_TRUE(surface.project(p, back));
    p = back.p;
    v = (v - back.n.dot(v) * back.n).normalized();
  }
  return p;
}

TEST(DefaultRetract, EndsWhereTheGeodesicDoesButForTheFourthPower) {
  const Plain surface;
  std::mt19937 random(10);
  std::uniform_real_distribution<double> angle(0, 2 * M_PI);
  double worst[3] = {0, 0, 0};
  for (int k = 0; k < 40; ++k) {
    const double u = angle(random), v = angle(random), w = angle(random);
    const Vec3 radial(std::cos(u), std::sin(u), 0);
    SurfacePoint from, there;
    ASSERT_TRUE(surface.project(0.015 * radial + 0.006 * (std::cos(v) * radial + std::sin(v) * Vec3::UnitZ()), from));
    for (int i = 0; i < 3; ++i) {
      const Vec2 ds = 8e-4 / (1 << i) * Vec2(std::cos(w), std::sin(w));
      ASSERT_TRUE(surface.retract(from, ds, there));
      worst[i] = std::max(worst[i], (there.p - geodesic_end(surface, from, ds)).norm());
    }
  }
  EXPECT_LT(worst[0], std::pow(8e-4, 4) / std::pow(0.005, 3));
  EXPECT_NEAR(worst[0] / worst[1], 16, 3);
  EXPECT_NEAR(worst[1] / worst[2], 16, 3);
}

}  // namespace
}  // namespace genu
