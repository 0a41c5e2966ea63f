// Analytic surfaces against closed forms, finite differences, brute force and invariance.
#include "genu/surface/analytic.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "genu/core/decompositions.h"
#include "support/finite_difference.h"

namespace genu {
namespace {

using Make = std::function<std::unique_ptr<Surface>(const Pose&, bool)>;

// A surface, its placement, and how to draw points near it in its own frame.
struct FormulaShape {
  std::string name;
  Make make;
  double length;  ///< smallest radius of curvature, about: the scale of steps, m
};

const std::vector<PolynomialTerm> kPlateau{{0, 0, 2e-3}, {1, 0, 0.1}, {0, 1, -0.05}, {2, 0, 12}, {1, 1, -7},
                                           {0, 2, -9},   {3, 0, 150}, {2, 1, 90},    {0, 4, 3e3}};
const std::vector<PolynomialTerm> kCondyle{{0, 0, 0.02}, {1, 0, 1e-3}, {2, 0, -8e-4}, {0, 1, 0.1},
                                           {0, 2, -9},   {1, 1, 0.03}, {3, 0, 2e-4}};

void PrintTo(const FormulaShape& c, std::ostream* out) { *out << c.name; }

std::vector<FormulaShape> formula_shapes() {
  return {
      {"plane", [](const Pose& X, bool inside) { return make_plane(X, inside); }, 0.02},
      {"sphere", [](const Pose& X, bool inside) { return make_sphere(X, 0.02, inside); }, 0.02},
      {"ellipsoid",
       [](const Pose& X, bool inside) {
         return make_ellipsoid(X, {0.03, 0.02, 0.012}, inside);
       },
       0.005},
      {"cylinder", [](const Pose& X, bool inside) { return make_cylinder(X, 0.017, inside); }, 0.017},
      {"torus", [](const Pose& X, bool inside) { return make_torus(X, 0.015, 0.005, inside); }, 0.005},
      {"polynomial", [](const Pose& X, bool inside) { return make_polynomial(X, kPlateau, inside); }, 0.01},
      {"cylindrical", [](const Pose& X, bool inside) { return make_cylindrical_polynomial(X, kCondyle, inside); },
       0.01},
  };
}

class RandomPoses {
 public:
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Vec3 vector(double size) { return Vec3(in(-size, size), in(-size, size), in(-size, size)); }
  Pose pose() { return {exp_rotation(vector(3.0)), vector(0.1)}; }

 private:
  std::mt19937 engine_{20240611};
};

// Points of a surface: random points of a box round it, projected, away from the cut of the cylindrical chart.
std::vector<SurfacePoint> random_points(const FormulaShape& c, const Surface& surface, const Pose& X,
                                        RandomPoses& random, int count) {
  std::vector<SurfacePoint> points;
  while (static_cast<int>(points.size()) < count) {
    const Vec3 x = random.vector(0.03);
    if (c.name == "cylindrical" && (std::abs(std::atan2(x.y(), x.x())) > 2.5 || x.head<2>().norm() < 0.01)) continue;
    if (c.name == "polynomial" && std::abs(x.z()) > 0.01) continue;
    SurfacePoint s;
    if (surface.project(X * x, s)) points.push_back(s);
  }
  return points;
}

class Analytic : public ::testing::TestWithParam<FormulaShape> {
 protected:
  RandomPoses random_;
};

TEST_P(Analytic, FrameIsOrthonormalRightHandedAndShapeOperatorSymmetric) {
  for (const bool inside : {false, true}) {
    const Pose X = random_.pose();
    const auto surface = GetParam().make(X, inside);
    for (const SurfacePoint& s : random_points(GetParam(), *surface, X, random_, 200)) {
      Mat3 frame;
      frame << s.T, s.n;
      EXPECT_LT((frame.transpose() * frame - Mat3::Identity()).norm(), 1e-14);
      EXPECT_NEAR(frame.determinant(), 1, 1e-14);
      EXPECT_EQ(s.S(0, 1), s.S(1, 0));
    }
  }
}

TEST_P(Analytic, DerivativesAgreeWithFiniteDifferencesAlongRetract) {
  double worst_p = 0, worst_bend = 0, worst_n = 0;
  const double h = 2e-3 * GetParam().length;
  for (const bool inside : {false, true}) {
    const Pose X = random_.pose();
    const auto surface = GetParam().make(X, inside);
    for (const SurfacePoint& s : random_points(GetParam(), *surface, X, random_, 200)) {
      const double angle = random_.in(0, 2 * std::numbers::pi);
      const Vec2 d(std::cos(angle), std::sin(angle));
      const auto step = [&](double length) {
        SurfacePoint out;
        EXPECT_TRUE(surface->retract(s, length * d, out));
        return out;
      };
      const auto p = [&](double length) -> Vec3 { return step(length).p; };
      const auto n = [&](double length) -> Vec3 { return step(length).n; };
      worst_p = std::max(worst_p, (test::derivative(p, h) - s.T * d).norm());
      // A retraction of second order: the curve bends along the normal alone, by the normal curvature.
      const Vec3 bend = test::second_derivative(p, h);
      worst_bend = std::max(worst_bend, (bend - d.dot(s.S * d) * s.n).norm() * GetParam().length);
      worst_n = std::max(worst_n, (test::derivative(n, h) + s.T * s.S * d).norm() * GetParam().length);
    }
  }
  EXPECT_LT(worst_p, 1e-9);
  EXPECT_LT(worst_bend, 1e-6);
  EXPECT_LT(worst_n, 1e-9);
}

TEST_P(Analytic, ProjectIsIdempotentAndAlongTheNormal) {
  double worst = 0;
  const Pose X = random_.pose();
  const auto surface = GetParam().make(X, false);
  for (const SurfacePoint& s : random_points(GetParam(), *surface, X, random_, 200)) {
    const double height = random_.in(-0.3, 0.3) * GetParam().length;
    for (const Vec3& x : {s.p, Vec3(s.p + height * s.n)}) {
      SurfacePoint again;
      ASSERT_TRUE(surface->project(x, again));
      worst = std::max(worst, (again.p - s.p).norm());
    }
  }
  EXPECT_LT(worst, 1e-14);
}

TEST_P(Analytic, GapIsTheSignedDistanceAndInsideTurnsEverythingRound) {
  double worst = 0;
  const Pose X = random_.pose();
  const auto outer = GetParam().make(X, false), inner = GetParam().make(X, true);
  for (const SurfacePoint& s : random_points(GetParam(), *outer, X, random_, 200)) {
    const double height = random_.in(-0.3, 0.3) * GetParam().length;
    const Vec3 x = s.p + height * s.n;
    const auto gap = outer->gap(x), turned = inner->gap(x);
    ASSERT_TRUE(gap && turned);
    worst = std::max({worst, std::abs(*gap - height), std::abs(*turned + height)});
    SurfacePoint t;
    ASSERT_TRUE(inner->project(s.p, t));
    worst = std::max({worst, (t.n + s.n).norm() * 1e-3, (t.p - s.p).norm()});
    // S as a map of the tangent plane, which does not depend on the basis.
    const Mat3 outer_map = s.T * s.S * s.T.transpose(), inner_map = t.T * t.S * t.T.transpose();
    EXPECT_LT((outer_map + inner_map).norm(), 1e-9 * (1 + s.S.norm()));
  }
  EXPECT_LT(worst, 1e-14);
}

TEST_P(Analytic, MovesWithItsBody) {
  const Pose X = random_.pose(), motion = random_.pose();
  const auto here = GetParam().make(X, false), there = GetParam().make(motion * X, false);
  double worst = 0;
  for (const SurfacePoint& s : random_points(GetParam(), *here, X, random_, 100)) {
    SurfacePoint t;
    ASSERT_TRUE(there->project(motion * s.p, t));
    worst = std::max({worst, (t.p - motion * s.p).norm(), 1e-3 * (t.n - motion.R * s.n).norm()});
    const Mat3 moved = motion.R * (s.T * s.S * s.T.transpose()) * motion.R.transpose();
    EXPECT_LT((moved - t.T * t.S * t.T.transpose()).norm(), 1e-9 * (1 + s.S.norm()));
  }
  EXPECT_LT(worst, 1e-14);
}

TEST_P(Analytic, NoTriangleVertexIsNearerThanTheFootPoint) {
  const Pose X = random_.pose();
  const auto surface = GetParam().make(X, false);
  const Mesh mesh = surface->triangles(1e-3, X.p, 0.03);
  double worst = 0;
  for (const SurfacePoint& s : random_points(GetParam(), *surface, X, random_, 30)) {
    const Vec3 x = s.p + random_.in(-0.5, 1.0) * GetParam().length * s.n;
    SurfacePoint foot;
    if (!surface->project(x, foot)) continue;
    for (const Vec3& v : mesh.vertices) worst = std::max(worst, (x - foot.p).norm() - (x - v).norm());
  }
  EXPECT_LT(worst, 1e-15);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Analytic, ::testing::ValuesIn(formula_shapes()),
                         [](const auto& c) { return c.param.name; });

SurfacePoint at(const Surface& surface, const Vec3& x) {
  SurfacePoint s;
  EXPECT_TRUE(surface.project(x, s)) << x.transpose();
  return s;
}

TEST(AnalyticClosedForms, CurvaturesAreTheTextbookOnes) {
  EXPECT_NEAR((at(*make_sphere({}, 2, false), {1, 2, 3}).S + 0.5 * Mat2::Identity()).norm(), 0, 1e-15);
  const auto torus = make_torus({}, 15, 5, false);
  const auto curvatures = [](const SurfacePoint& s) { return symmetric_eigenvalues(s.S); };
  EXPECT_NEAR((curvatures(at(*torus, {21, 0, 0})) - Vec2(-1 / 5.0, -1 / 20.0)).norm(), 0, 1e-15);
  EXPECT_NEAR((curvatures(at(*torus, {0, 9, 0})) - Vec2(-1 / 5.0, 1 / 10.0)).norm(), 0, 1e-15);  // inner equator
  EXPECT_NEAR((curvatures(at(*torus, {0, 15, 6})) - Vec2(-1 / 5.0, 0)).norm(), 0, 1e-15);
  const auto ellipsoid = make_ellipsoid({}, {3, 2, 1}, false);
  EXPECT_NEAR((curvatures(at(*ellipsoid, {4, 0, 0})) - Vec2(-3 / 1.0, -3 / 4.0)).norm(), 0, 1e-14);  // a / c^2, a / b^2
  EXPECT_NEAR((curvatures(at(*ellipsoid, {0, 0, 2})) - Vec2(-1 / 4.0, -1 / 9.0)).norm(), 0, 1e-15);
  const auto bowl = make_polynomial({}, {{2, 0, 3}, {0, 2, 0.5}}, false);
  EXPECT_NEAR((curvatures(at(*bowl, {0, 0, 0.01})) - Vec2(1, 6)).norm(), 0, 1e-14);
}

TEST(AnalyticClosedForms, ConstantPolynomialsAreAPlaneAndACylinder) {
  RandomPoses random;
  const Pose X = random.pose();
  const auto plane = make_plane(X, false), flat = make_polynomial(X, {{0, 0, 0.0}}, false);
  const auto cylinder = make_cylinder(X, 0.02, true), round = make_cylindrical_polynomial(X, {{0, 0, 0.02}}, true);
  double worst = 0;
  for (int k = 0; k < 100; ++k) {
    const Vec3 x = X * random.vector(0.03);
    worst = std::max({worst, std::abs(*plane->gap(x) - *flat->gap(x)), std::abs(*cylinder->gap(x) - *round->gap(x))});
    const SurfacePoint a = at(*cylinder, x), b = at(*round, x);
    worst = std::max({worst, (a.p - b.p).norm(), 1e-3 * (a.n - b.n).norm(), 1e-6 * (a.S - b.S).norm()});
  }
  EXPECT_LT(worst, 1e-15);
}

TEST(AnalyticClosedForms, EllipsoidOfEqualRadiiIsASphere) {
  RandomPoses random;
  const auto sphere = make_sphere({}, 0.02, false), ellipsoid = make_ellipsoid({}, Vec3::Constant(0.02), false);
  double worst = 0;
  for (int k = 0; k < 1000; ++k) {
    const Vec3 x = random.vector(std::pow(10, random.in(-5, 3)));
    const SurfacePoint a = at(*sphere, x), b = at(*ellipsoid, x);
    worst = std::max({worst, (a.p - b.p).norm() / 0.02, std::abs(*sphere->gap(x) / *ellipsoid->gap(x) - 1) * 1e-2});
  }
  EXPECT_LT(worst, 1e-14);
}

TEST(AnalyticEllipsoid, FootIsTheNearestPointEverywhereEvenOnTheFlatSet) {
  const Vec3 radii(0.03, 0.02, 0.004);
  const auto ellipsoid = make_ellipsoid({}, radii, false);
  const Mesh mesh = ellipsoid->triangles(5e-4, Vec3::Zero(), 1);
  RandomPoses random;
  for (int k = 0; k < 200; ++k) {
    Vec3 x = random.vector(0.03);
    if (k % 2 == 0) x.z() = k % 4 == 0 ? 0 : 1e-12;
    const auto gap = ellipsoid->gap(x);
    ASSERT_TRUE(gap);
    EXPECT_EQ(*gap < 0, x.cwiseQuotient(radii).norm() < 1);
    double nearest = 1;
    for (const Vec3& v : mesh.vertices) nearest = std::min(nearest, (v - x).norm());
    EXPECT_LE(std::abs(*gap), nearest + 1e-15);
    EXPECT_GT(std::abs(*gap), nearest - 3e-4) << x.transpose();
  }
}

TEST(AnalyticRefusals, PointsWithoutOneClosestPoint) {
  SurfacePoint s;
  EXPECT_FALSE(make_sphere({}, 1, false)->project(Vec3::Zero(), s));
  EXPECT_FALSE(make_ellipsoid({}, {3, 2, 1}, false)->project(Vec3::Zero(), s));
  EXPECT_FALSE(make_cylinder({}, 1, false)->project({0, 0, 5}, s));
  const auto torus = make_torus({}, 3, 1, false);
  EXPECT_FALSE(torus->project({0, 0, 0.5}, s));
  EXPECT_FALSE(torus->project({0, 3, 0}, s));
  EXPECT_NEAR(*torus->gap({0, 3, 0}), -1, 1e-15);
  const double nan = std::nan("");
  for (const FormulaShape& c : formula_shapes())
    EXPECT_FALSE(c.make({}, false)->project({nan, 0.01, 0.01}, s)) << c.name;
}

TEST(AnalyticRefusals, ArgumentsThatMakeNoSurface) {
  EXPECT_FALSE(make_sphere({}, 0, false));
  EXPECT_FALSE(make_sphere({}, std::nan(""), false));
  EXPECT_FALSE(make_cylinder({}, -1, false));
  EXPECT_FALSE(make_ellipsoid({}, {1, 1, 0}, false));
  EXPECT_FALSE(make_torus({}, 1, 1, false));
  EXPECT_FALSE(make_polynomial({}, {}, false));
  EXPECT_FALSE(make_polynomial({}, {{-1, 0, 1.0}}, false));
  EXPECT_FALSE(make_polynomial({}, {{0, kMaxPolynomialExponent + 1, 1.0}}, false));
}

}  // namespace
}  // namespace genu
