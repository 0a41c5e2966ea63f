// Strings over one sphere or cylinder: against planes and unrolled sheets drawn by hand, and against the general search
// on surfaces that are round without saying so.
#include "genu/wrap/round_string.h"

#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include "genu/surface/analytic.h"
#include "genu/wrap/taut_string.h"

namespace genu {
namespace {

constexpr double kRadius = 0.02;

Geodesic begun(const Vec3& p, const Vec3& t, double length) {
  Geodesic arc;
  arc.begin.p = p;
  arc.begin.t = t;
  arc.length = length;
  return arc;
}

RoundShape cylinder_shape(const Vec3& axis) { return {Vec3(0.001, 0.002, 0.003), axis, kRadius, false}; }

/// A round surface that the general search is used on.
class Unsaid : public Surface {
 public:
  explicit Unsaid(std::unique_ptr<Surface> shape) : shape_(std::move(shape)) {}
  bool project(const Vec3& x, SurfacePoint& out) const override { return shape_->project(x, out); }
  std::optional<double> gap(const Vec3& x) const override { return shape_->gap(x); }
  bool bending(const Vec3& x, const Vec3& t, Bending& out) const override { return shape_->bending(x, t, out); }
  Mesh triangles(double edge, const Vec3& centre, double reach) const override {
    return shape_->triangles(edge, centre, reach);
  }

 private:
  std::unique_ptr<Surface> shape_;
};

TEST(RoundString, OverTheTopOfACylinder) {
  // Both points at the height of the axis: a quarter less the angles of the tangents, on each side.
  const RoundShape shape{Vec3::Zero(), Vec3::UnitZ(), kRadius, false};
  for (const double climb : {0.0, 0.03}) {
    Geodesic arc = begun({0, kRadius, 0}, Vec3::UnitX(), 0);
    ASSERT_TRUE(place_round_arc(shape, {-0.04, 0, 0}, {0.05, 0, climb}, arc));
    const double first = std::sqrt(0.04 * 0.04 - kRadius * kRadius), last = std::sqrt(0.05 * 0.05 - kRadius * kRadius);
    const double round = kRadius * (std::asin(kRadius / 0.04) + std::asin(kRadius / 0.05));
    const double stretch = std::hypot(1, climb / (first + round + last));
    EXPECT_NEAR(arc.length, round * stretch, 1e-16);
    EXPECT_NEAR(arc.begin.p.head<2>().norm(), kRadius, 1e-16);
    EXPECT_NEAR((arc.begin.p - Vec3(-0.04, 0, 0)).norm(), first * stretch, 1e-16);
    EXPECT_NEAR(arc.begin.t.norm(), 1, 1e-15);
  }
}

TEST(RoundString, KeepsItsSideAndItsTurns) {
  const RoundShape shape{Vec3::Zero(), Vec3::UnitZ(), kRadius, false};
  const Vec3 from(-0.04, 0, 0), to(0.05, 0, 0);
  Geodesic above = begun({0, kRadius, 0}, Vec3::UnitX(), 0.01), below = begun({0, -kRadius, 0}, Vec3::UnitX(), 0.01);
  ASSERT_TRUE(place_round_arc(shape, from, to, above));
  ASSERT_TRUE(place_round_arc(shape, from, to, below));
  EXPECT_GT(above.begin.p.y(), 0);
  EXPECT_LT(below.begin.p.y(), 0);
  EXPECT_NEAR(above.length, below.length, 1e-16);
  Geodesic twice = begun({0, kRadius, 0}, Vec3::UnitX(), above.length + 2 * EIGEN_PI * kRadius);
  ASSERT_TRUE(place_round_arc(shape, from, to, twice));
  EXPECT_NEAR(twice.length - above.length, 2 * EIGEN_PI * kRadius, 1e-16);
}

TEST(RoundString, GoesOnBeyondTheTouchWithANegativeLength) {
  const RoundShape shape{Vec3::Zero(), Vec3::UnitZ(), kRadius, false};
  double last = 1;
  for (const double height : {0.0199, 0.02, 0.0201}) {
    Geodesic arc = begun({0, kRadius, 0}, Vec3::UnitX(), 1e-4);
    ASSERT_TRUE(place_round_arc(shape, {-0.04, height, 0}, {0.05, height, 0}, arc));
    EXPECT_EQ(arc.length > 0, height < kRadius) << height;
    EXPECT_LT(arc.length, last);
    last = arc.length;
    EXPECT_LT(std::abs(arc.length), 1e-3);
  }
}

TEST(RoundString, NoneFromWithinOrWithoutASense) {
  const RoundShape ball{Vec3::Zero(), Vec3::Zero(), kRadius, false};
  Geodesic arc = begun({0, kRadius, 0}, Vec3::UnitX(), 0.01);
  EXPECT_FALSE(place_round_arc(ball, {-0.01, 0.001, 0}, {0.05, 0, 0}, arc));  // a point within
  EXPECT_FALSE(place_round_arc(ball, {-0.04, 0, 0}, {0.05, 0, 0}, arc));      // opposite points: every plane
  const RoundShape rod{Vec3::Zero(), Vec3::UnitX(), kRadius, false};
  EXPECT_FALSE(place_round_arc(rod, {-0.04, 0.03, 0}, {0.05, 0, 0.03}, arc));  // along the axis
  arc.length = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(place_round_arc(ball, {-0.04, 0.001, 0}, {0.05, 0, 0.01}, arc));
  RoundShape bore = cylinder_shape(Vec3::UnitZ());
  bore.inside = true;
  arc.length = 0.01;
  EXPECT_FALSE(place_round_arc(bore, {-0.04, 0.001, 0}, {0.05, 0, 0.01}, arc));
}

/// A walk of both ends, the string carried on from step to step by both ways.
void expect_as_searched_for(std::unique_ptr<Surface> round, std::unique_ptr<Surface> same, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto step = [&] {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    return Vec3(1e-3 * Vec3(x, y, z));
  };
  const Unsaid unsaid(std::move(same));
  const std::vector<Obstacle> said{{round.get(), Pose()}}, searched{{&unsaid, Pose()}};
  std::vector<Geodesic> a{begun({0, kRadius, 0}, Vec3(1, 0.02, 0.1).normalized(), 0.02)}, b = a;
  Vec3 from(-0.035, 0.004, -0.003), to(0.034, -0.006, 0.005);
  for (int k = 0; k < 200; ++k) {
    ASSERT_TRUE(solve_string(from, to, said, a)) << k;
    ASSERT_TRUE(solve_string(from, to, searched, b)) << k;
    ASSERT_NEAR(a[0].length, b[0].length, 1e-13) << k;
    ASSERT_LT((a[0].begin.p - b[0].begin.p).norm(), 1e-13) << k;
    ASSERT_LT((a[0].end.p - b[0].end.p).norm(), 1e-13) << k;
    ASSERT_NEAR(a[0].a, b[0].a, 1e-12) << k;
    const Vec3 new_from = from + step(), new_to = to + step();
    if (new_from.norm() > 1.2 * kRadius && new_from.x() < -0.025) from = new_from;
    if (new_to.norm() > 1.2 * kRadius && new_to.x() > 0.025) to = new_to;
  }
}

TEST(RoundString, OfASphereIsTheOneThatIsSearchedFor) {
  for (unsigned seed = 1; seed <= 5; ++seed)
    expect_as_searched_for(make_sphere({}, kRadius, false), make_sphere({}, kRadius, false), seed);
}

TEST(RoundString, OfACylinderIsTheOneThatIsSearchedFor) {
  const Pose X{exp_rotation(Vec3(0.2, -0.1, 0.5)), Vec3(1e-3, -1e-3, 2e-3)};
  for (unsigned seed = 1; seed <= 5; ++seed)
    expect_as_searched_for(make_cylinder(X, kRadius, false), make_cylinder(X, kRadius, false), seed);
}

}  // namespace
}  // namespace genu
