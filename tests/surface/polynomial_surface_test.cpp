#include "genu/surface/polynomial_surface.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace genu {
namespace {

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
