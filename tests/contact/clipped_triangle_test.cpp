#include "genu/contact/clipped_triangle.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

/// Sums l_i l_j and l_i over many small triangles whose middle has a positive p: off by about an edge squared.
ClippedIntegrals brute_force(double area, const Vec3& p, int n) {
  ClippedIntegrals out;
  const double part = area / (n * n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j)
      for (const double up : {1.0 / 3, 2.0 / 3}) {
        if (up > 0.5 && i + j + 1 >= n) continue;
        const double x = (i + up) / n, y = (j + up) / n;
        const Vec3 l(1 - x - y, x, y);
        if (!(l.dot(p) > 0)) continue;
        out.mass += part * l * l.transpose();
        out.share += part * l;
      }
  return out;
}

TEST(ClippedTriangle, AgreesWithSumsOverSmallTriangles) {
  double worst = 0;
  for (const Vec3& p : {Vec3(1, 2, 3), Vec3(-1, 2, 3), Vec3(1, -2, 0.5), Vec3(-1, -2, 3), Vec3(0.3, -5, -0.1)}) {
    ClippedIntegrals exact;
    ASSERT_TRUE(clipped_integrals(2, p, exact));
    const ClippedIntegrals sums = brute_force(2, p, 800);
    worst = std::max({worst, (exact.mass - sums.mass).norm(), (exact.share - sums.share).norm()});
  }
  EXPECT_LT(worst, 2e-4) << worst;
}

TEST(ClippedTriangle, IntegralOfPressureHasTheMassAsItsDerivative) {
  constexpr double kStep = 1e-6;
  double worst = 0;
  for (const Vec3& p : {Vec3(1, 2, 3), Vec3(-1, 2, 3), Vec3(1, -2, 0.5), Vec3(-1, -2, 3), Vec3(0, 1, -1)}) {
    ClippedIntegrals here, plus, minus;
    ASSERT_TRUE(clipped_integrals(2, p, here));
    for (Eigen::Index j = 0; j < 3; ++j) {
      const Vec3 step = kStep * Vec3::Unit(j);
      ASSERT_TRUE(clipped_integrals(2, p + step, plus) && clipped_integrals(2, p - step, minus));
      const Vec3 slope = (plus.mass * (p + step) - minus.mass * (p - step)) / (2 * kStep);
      worst = std::max(worst, (slope - here.mass.col(j)).norm());
    }
  }
  EXPECT_LT(worst, 1e-6) << worst;
}

TEST(ClippedTriangle, NothingWherePressureIsNotPositive) {
  ClippedIntegrals out;
  EXPECT_FALSE(clipped_integrals(1, {0, -1, -2}, out));
  EXPECT_TRUE(out.mass.isZero(0));
  ASSERT_TRUE(clipped_integrals(1, {0, 1, 1}, out));
  EXPECT_DOUBLE_EQ(out.share.sum(), 1);
}

}  // namespace
}  // namespace genu
