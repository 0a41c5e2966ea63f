#include "genu/osim/function.h"

#include <cmath>

#include <gtest/gtest.h>

namespace genu::osim {
namespace {

Function through(Function::Kind kind, std::vector<double> x, std::vector<double> y) {
  Function f;
  f.kind = kind;
  f.x = std::move(x);
  f.y = std::move(y);
  return f;
}

TEST(Function, OfCoefficientsIsAPolynomial) {
  Function f;
  f.kind = Function::Kind::polynomial;
  f.coefficients = {2, -3, 5};
  f.scale = 10;
  EXPECT_DOUBLE_EQ(f(4), 10 * (2 * 16 - 3 * 4 + 5));
  EXPECT_DOUBLE_EQ(Function()(3), 0);
}

TEST(Function, PiecewiseLinearContinuesItsEnds) {
  const Function f = through(Function::Kind::piecewise_linear, {0, 1, 3}, {0, 2, 0});
  EXPECT_DOUBLE_EQ(f(0.5), 1);
  EXPECT_DOUBLE_EQ(f(2), 1);
  EXPECT_DOUBLE_EQ(f(-1), -2);
  EXPECT_DOUBLE_EQ(f(4), -1);
}

/// The spline's ends have the third derivatives of the cubics through four points, so it brings back every cubic.
TEST(Function, SplineOfACubicIsThatCubic) {
  const auto cubic = [](double x) { return 0.3 + x * (-1.2 + x * (0.7 - 0.25 * x)); };
  std::vector<double> x = {-1.3, -0.2, 0.1, 0.9, 2.5, 2.6}, y;
  for (const double v : x) y.push_back(cubic(v));
  const Function f = through(Function::Kind::spline, x, y);
  for (double v = -1.3; v <= 2.6; v += 0.01) EXPECT_NEAR(f(v), cubic(v), 1e-13) << v;
}

TEST(Function, SplineIsSmoothAndStraightBeyondItsEnds) {
  const Function f = through(Function::Kind::spline, {0, 1, 2, 4}, {0, 1, 0, 3});
  for (const double knot : {1.0, 2.0}) {
    const double h = 1e-4;
    EXPECT_NEAR(f(knot + h) - 2 * f(knot) + f(knot - h), 0, 1e-6);  // no corner
    const double left = (f(knot) - 2 * f(knot - h) + f(knot - 2 * h)) / (h * h);
    const double right = (f(knot + 2 * h) - 2 * f(knot + h) + f(knot)) / (h * h);
    EXPECT_NEAR(left, right, 1e-2);
  }
  for (const double end : {0.0, 4.0}) {
    const double out = end == 0 ? -1 : 1;
    EXPECT_NEAR(f(end + 2 * out) - f(end + out), f(end + out) - f(end), 1e-12);
    EXPECT_NEAR((f(end + 1e-6 * out) - f(end)), f(end) - f(end - 1e-6 * out), 1e-10);
  }
}

TEST(Function, SplineOfTwoOrThreePointsIsDefined) {
  const Function two = through(Function::Kind::spline, {-2, 2}, {2, -2});
  EXPECT_DOUBLE_EQ(two(0.5), -0.5);
  EXPECT_DOUBLE_EQ(two(5), -5);
  const Function three = through(Function::Kind::spline, {0, 1, 2}, {0, 1, 4});
  for (const double x : {0.0, 1.0, 2.0}) EXPECT_NEAR(three(x), x * x, 1e-14);
}

}  // namespace
}  // namespace genu::osim
