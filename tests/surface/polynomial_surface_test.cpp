#include "genu/surface/polynomial_surface.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(Polynomial, ValueAndDerivativesOfEveryTermAgainstPowers) {
  const std::vector<PolynomialTerm> terms{{0, 0, 2.0}, {3, 1, -1.5}, {0, 4, 0.7},
                                          {5, 0, 0.3}, {2, 2, 1.1},  {3, 1, 0.5}};
  const Polynomial P(terms);
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> in(-2, 2);
  double worst = 0;
  for (int k = 0; k < 200; ++k) {
    const double x = in(engine), y = in(engine);
    const PolynomialJet jet = P(x, y);
    // d^a/dx^a d^b/dy^b c x^i y^j
    const auto power = [](double v, int n, int d) {
      double factor = 1;
      for (int m = 0; m < d; ++m) factor *= n - m;
      return factor == 0 ? 0.0 : factor * std::pow(v, n - d);
    };
    const auto sum = [&](int a, int b) {
      double s = 0;
      for (const auto& t : terms) s += t.c * power(x, t.i, a) * power(y, t.j, b);
      return s;
    };
    worst = std::max({worst, std::abs(jet.f - sum(0, 0)), std::abs(jet.x - sum(1, 0)), std::abs(jet.y - sum(0, 1)),
                      std::abs(jet.xx - sum(2, 0)), std::abs(jet.xy - sum(1, 1)), std::abs(jet.yy - sum(0, 2))});
  }
  EXPECT_LT(worst, 1e-12);
}

TEST(Polynomial, HighestExponentsAndZeroCoefficients) {
  const Polynomial P({{kMaxPolynomialExponent, kMaxPolynomialExponent, 1.0}, {1, 0, 0.0}});
  EXPECT_EQ(P.value(1, 1), 1);
  EXPECT_EQ(P(1, 1).xy, kMaxPolynomialExponent * kMaxPolynomialExponent);
  EXPECT_TRUE(P.depends_on_x());
  EXPECT_FALSE(Polynomial({{4, 0, 0.0}, {0, 2, 1.0}}).depends_on_x());
}

TEST(SurfacePointOfAChart, DoesNotDependOnTheParametersOfTheChart) {
  // A sphere of radius 2, in latitude and longitude and in stretched, skew parameters of the same.
  const auto jet = [](double a, double b, const Mat2& M) {
    const Vec2 u = M * Vec2(a, b);
    const double cu = std::cos(u.x()), su = std::sin(u.x()), cv = std::cos(u.y()), sv = std::sin(u.y());
    const Vec3 pu(-2 * su * cv, 2 * cu * cv, 0), pv(-2 * cu * sv, -2 * su * sv, 2 * cv);
    const Vec3 puu(-2 * cu * cv, -2 * su * cv, 0), puv(2 * su * sv, -2 * cu * sv, 0),
        pvv(-2 * cu * cv, -2 * su * cv, -2 * sv);
    ChartJet j;
    j.p = Vec3(2 * cu * cv, 2 * su * cv, 2 * sv);
    j.u = M(0, 0) * pu + M(1, 0) * pv;
    j.v = M(0, 1) * pu + M(1, 1) * pv;
    const auto second = [&](int r, int s) -> Vec3 {
      return M(0, r) * M(0, s) * puu + (M(0, r) * M(1, s) + M(1, r) * M(0, s)) * puv + M(1, r) * M(1, s) * pvv;
    };
    j.uu = second(0, 0);
    j.uv = second(0, 1);
    j.vv = second(1, 1);
    return j;
  };
  Mat2 skewed;
  skewed << 3, 0.7, -0.4, 0.2;
  for (const Mat2& M : {Mat2(Mat2::Identity()), skewed}) {
    const SurfacePoint s = surface_point(jet(0.3, 0.8, M));
    EXPECT_NEAR((s.n - s.p / 2).norm(), 0, 1e-14);
    EXPECT_NEAR((s.S + 0.5 * Mat2::Identity()).norm(), 0, 1e-13);
  }
}

}  // namespace
}  // namespace genu
