// Hertz's contact against its closed form for spheres, the library's elliptic integrals, published ellipses, and the
// integral equation that it solves.
#include "genu/contact/hertz.h"

#include <cmath>
#include <cstdio>
#include <numbers>

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(Hertz, EllipticIntegrals) {
  double worst = 0;
  for (const double k : {0.001, 0.1, 0.5, 0.9, 0.99, 0.9999}) {
    const double m1 = (1 - k) * (1 + k), K = std::comp_ellint_1(k), E = std::comp_ellint_2(k);
    worst = std::max(worst, std::abs(carlson_rf0(m1, 1) / K - 1));
    worst = std::max(worst, std::abs((K - k * k * carlson_rd0(m1, 1) / 3) / E - 1));
    worst = std::max(worst, std::abs((m1 * K + m1 * k * k * carlson_rd0(1, m1) / 3) / E - 1));
  }
  std::printf("elliptic integrals off by %.1e\n", worst);
  EXPECT_LT(worst, 1e-12);  // of the library's own rounding near 1
  // Legendre's relation between the integrals of k and of its complement: E K' + E' K - K K' = pi/2.
  for (const double m : {1e-6, 0.01, 0.3, 0.5}) {
    const auto K = [](double k2) { return carlson_rf0(1 - k2, 1); };
    const auto E = [&](double k2) { return K(k2) - k2 * carlson_rd0(1 - k2, 1) / 3; };
    EXPECT_NEAR((E(m) - K(m)) * K(1 - m) + E(1 - m) * K(m), std::numbers::pi / 2, 3e-15 * K(1 - m) * K(m));
  }
  EXPECT_NEAR(carlson_rd0(1, 1), 0.75 * std::numbers::pi, 1e-14);
  EXPECT_NEAR(carlson_rd0(2, 1), 1.7972103521033883, 1e-14);  // Carlson 1995, section 3: R_D(0, 2, 1)
  EXPECT_NEAR(carlson_rf0(1, 2), 1.3110287771461, 1e-13);     // R_F(1, 2, 0)
}

TEST(Hertz, SphereOnAPlane) {
  const double R = 0.025, E = 1.3e7, d = 2e-4;
  const HertzContact c = hertz(1 / R, 1 / R, E, d);
  EXPECT_NEAR(c.a / std::sqrt(R * d), 1, 1e-13);
  EXPECT_NEAR(c.b / c.a, 1, 1e-13);
  EXPECT_NEAR(c.force / (4.0 / 3 * E * std::sqrt(R) * std::pow(d, 1.5)), 1, 1e-13);
  EXPECT_NEAR(c.peak_pressure / (2 * E * c.a / (std::numbers::pi * R)), 1, 1e-13);
}

/// The table that every handbook has (Harris, Rolling Bearing Analysis, 1966): of F(rho) = (most - least) / (most +
/// least) the semi-axes a* and b* and the approach d*, in the units of the half space pressed by a given force.
TEST(Hertz, HandbookTable) {
  const struct {
    double F, a, b, d;
  } table[] = {{0.1075, 1.0760, 0.9318, 0.9974}, {0.3204, 1.2623, 0.8114, 0.9761}, {0.4795, 1.4556, 0.7278, 0.9429},
               {0.5916, 1.6440, 0.6687, 0.9077}, {0.6716, 1.8258, 0.6245, 0.8733}, {0.7332, 2.011, 0.5881, 0.8394},
               {0.90999, 3.233, 0.4499, 0.6636}};
  double worst = 0;
  for (const auto& row : table) {
    const double sum = 80, E = 1e7, most = 0.5 * sum * (1 + row.F), least = 0.5 * sum * (1 - row.F);
    const HertzContact c = hertz(least, most, E, 1e-4);
    // a = a* (3 F / (2 E* sum))^(1/3), d = d* (3 F / (2 E* sum))^(2/3) sum / 2
    const double unit = std::cbrt(1.5 * c.force / (E * sum));
    worst = std::max({worst, std::abs(c.a / unit / row.a - 1), std::abs(c.b / unit / row.b - 1),
                      std::abs(1e-4 / (unit * unit * 0.5 * sum) / row.d - 1)});
  }
  std::printf("handbook off by %.1e\n", worst);
  EXPECT_LT(worst, 3e-3);
}

/// The pressure p0 sqrt(1 - x^2/a^2 - y^2/b^2) must raise the half space by d - (least x^2 + most y^2) / 2 wherever it
/// acts: Boussinesq's integral over it, in polar coordinates round the point, where it is regular.
TEST(Hertz, SolvesTheHalfSpace) {
  const double E = 1e7, d = 1e-4;
  double worst = 0;
  for (const double ratio : {1.0, 2.0, 10.0, 100.0}) {
    const double least = 20, most = least * ratio;
    const HertzContact c = hertz(least, most, E, d);
    for (const auto& [u, v] : {std::pair{0.0, 0.0}, {0.5, 0.0}, {0.0, 0.6}, {0.5, -0.5}}) {
      const double x = u * c.a, y = v * c.b;
      double sum = 0;
      constexpr int kRound = 4000;
      for (int k = 0; k < kRound; ++k) {
        const double angle = 2 * std::numbers::pi * (k + 0.5) / kRound, cx = std::cos(angle), cy = std::sin(angle);
        // Along the ray p^2 / p0^2 = C - 2 B r - A r^2; its integral over r has a closed form.
        const double A = cx * cx / (c.a * c.a) + cy * cy / (c.b * c.b), B = x * cx / (c.a * c.a) + y * cy / (c.b * c.b);
        const double C = 1 - u * u - v * v, root = C + B * B / A;
        const double t = B / std::sqrt(A);  // shifted: integral of sqrt(root - s^2) ds / sqrt(A) from t on
        sum += 0.5 / std::sqrt(A) *
               (root * (0.5 * std::numbers::pi - std::asin(t / std::sqrt(root))) - t * std::sqrt(root - t * t));
      }
      const double raised = c.peak_pressure * sum * 2 * std::numbers::pi / kRound / (std::numbers::pi * E);
      worst = std::max(worst, std::abs(raised - (d - 0.5 * (least * x * x + most * y * y))) / d);
    }
  }
  std::printf("half space off by %.1e\n", worst);
  EXPECT_LT(worst, 1e-10);
}

TEST(Hertz, LongEllipsesStayFinite) {
  const HertzContact c = hertz(1e-3, 100, 1e7, 1e-4);
  EXPECT_TRUE(std::isfinite(c.force) && std::isfinite(c.peak_pressure));
  EXPECT_GT(c.a / c.b, 100);
}

}  // namespace
}  // namespace genu
