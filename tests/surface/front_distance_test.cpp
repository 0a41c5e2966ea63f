// The bound of a point's distance to a polynomial patch against all of the patch's points.
#include "genu/surface/front_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace genu {
namespace {

constexpr int kGrid = 120;
const Pose kPlaced{exp_rotation(Vec3(0.4, -1.1, 0.7)), Vec3(0.01, -0.02, 0.03)};

struct Case {
  const char* name;
  bool cylindrical, inside;
  ChartBox patch;
  std::vector<PolynomialTerm> terms;
};

const Case kCases[] = {
    {"plateau",
     false,
     false,
     {-0.016, 0.016, -0.011, 0.011},
     {{1, 0, 0.2}, {2, 0, 9}, {1, 1, -4}, {0, 3, 900}, {4, 1, 2e6}}},
    {"plateau seen from below", false, true, {-0.016, 0.016, -0.011, 0.011}, {{2, 0, -9}, {0, 2, 12}, {3, 1, 5e4}}},
    {"condyle",
     true,
     false,
     {-1.4, 1.4, -0.01, 0.01},
     {{0, 0, 0.024}, {1, 0, -0.002}, {2, 0, 0.003}, {4, 0, -0.001}, {0, 2, -40}}},
};

Vec3 on_patch(const Case& c, double u, double v) {
  double P = 0;
  for (const PolynomialTerm& t : c.terms) P += t.c * std::pow(u, t.i) * std::pow(v, t.j);
  return SurfaceChart{c.cylindrical, kPlaced}.position({u, v, P});
}

double nearest_of_grid(const Case& c, const Vec3& x) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kGrid; ++i)
    for (int j = 0; j <= kGrid; ++j)
      least = std::min(
          least, (on_patch(c, c.patch.u0 + c.patch.width() * i / kGrid, c.patch.v0 + c.patch.height() * j / kGrid) - x)
                     .norm());
  return least;
}

TEST(FrontDistance, IsNeverMoreThanTheDistanceAndOftenNearIt) {
  for (const Case& c : kCases) {
    const FrontDistance front({c.cylindrical, kPlaced}, c.patch, c.terms, c.inside);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> across(-0.7, 0.7), height(0, 0.02);
    double worst = 0, best = 0;
    for (int k = 0; k < 400; ++k) {
      const double u = across(random) * c.patch.width(), v = across(random) * c.patch.height();
      const double up = (c.inside ? -1 : 1) * height(random);
      const ChartPoint foot = SurfaceChart{c.cylindrical, kPlaced}.coordinates(
          on_patch(c, std::clamp(u, c.patch.u0, c.patch.u1), std::clamp(v, c.patch.v0, c.patch.v1)));
      const Vec3 x = SurfaceChart{c.cylindrical, kPlaced}.position({u, v, foot.h + up});
      const double bound = front(x), distance = nearest_of_grid(c, x);
      const bool beside = c.cylindrical && (u < c.patch.u0 || u > c.patch.u1);
      EXPECT_GT(bound, 0) << c.name << " " << u << " " << v << " " << up;
      EXPECT_LE(bound, distance) << c.name << " " << u << " " << v << " " << up;
      worst = std::max(worst, bound / distance);
      if (!beside && std::abs(up) > 0.002) best = std::max(best, bound / distance);
    }
    EXPECT_GT(best, 0.6) << c.name;
    fmt::print("  {:<24} bound / distance up to {:.3f}\n", c.name, worst);
  }
}

TEST(FrontDistance, BesideItIsTheDistanceToTheSides) {
  for (const Case& c : kCases) {
    const FrontDistance front({c.cylindrical, kPlaced}, c.patch, c.terms, c.inside);
    const SurfaceChart chart{c.cylindrical, kPlaced};
    for (const double below : {-0.004, 0.0, 0.01}) {
      const double r = (c.cylindrical ? 0.024 : 0) - below;
      EXPECT_GE(front(chart.position({0, c.patch.v1 + 0.003, r})), 0.003 - 1e-12) << c.name;
      const double turned = c.cylindrical ? 0.2 : 0.003;
      EXPECT_GE(front(chart.position({c.patch.u0 - turned, 0, r})),
                (c.cylindrical ? r * std::sin(turned) : turned) - 1e-12)
          << c.name;
    }
  }
}

TEST(FrontDistance, KnowsNothingBehind) {
  for (const Case& c : kCases) {
    const FrontDistance front({c.cylindrical, kPlaced}, c.patch, c.terms, c.inside);
    const SurfaceChart chart{c.cylindrical, kPlaced};
    for (const double down : {0.0, 0.001, 0.01}) {
      const ChartPoint p = chart.coordinates(on_patch(c, 0.3 * c.patch.u1, 0.2 * c.patch.v1));
      EXPECT_LT(front(chart.position({p.u, p.v, p.h - (c.inside ? -1 : 1) * down})), 1e-12) << c.name;
    }
  }
  // More than half a turn, a socket, and a radius that may vanish have no bound.
  const SurfaceChart turned{true, kPlaced};
  const Vec3 above = turned.position({0.1, 0, 0.05});
  EXPECT_EQ(FrontDistance(turned, {-2, 2, -0.01, 0.01}, {{0, 0, 0.02}}, false)(above), 0);
  EXPECT_EQ(FrontDistance(turned, {-1, 1, -0.01, 0.01}, {{0, 0, 0.02}}, true)(above), 0);
  EXPECT_EQ(FrontDistance(turned, {-1, 1, -0.01, 0.01}, {{1, 0, 0.02}}, false)(above), 0);
  EXPECT_GT(FrontDistance(turned, {-1, 1, -0.01, 0.01}, {{0, 0, 0.02}}, false)(above), 0.0299);
}

TEST(FrontDistance, BernsteinCoefficientsBoundThePolynomial) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> c(-1, 1);
  for (int degree = 0; degree <= 10; ++degree) {
    std::vector<PolynomialTerm> terms;
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; i + j <= degree; ++j) terms.push_back({i, j, c(random)});
    const ChartBox box{-0.8, 0.5, 0.1, 0.9};
    const auto [least, most] = polynomial_range(terms, box);
    const Polynomial P(terms);
    double low = 1e9, high = -1e9;
    for (int i = 0; i <= kGrid; ++i)
      for (int j = 0; j <= kGrid; ++j) {
        const double f = P.value(box.u0 + box.width() * i / kGrid, box.v0 + box.height() * j / kGrid);
        low = std::min(low, f);
        high = std::max(high, f);
      }
    EXPECT_LE(least, low + 1e-12) << degree;
    EXPECT_GE(most, high - 1e-12) << degree;
    EXPECT_LT(most - least, 4 * (high - low) + 1e-12) << degree;
  }
}

}  // namespace
}  // namespace genu
