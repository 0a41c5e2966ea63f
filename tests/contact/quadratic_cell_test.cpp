#include "genu/contact/quadratic_cell.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/random_points.h"

namespace genu {
namespace {

constexpr std::array<std::pair<double, double>, 6> kNodes{{{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}};

/// The triangle (0, 0), (1, 0), (0, 1), bent upward by `bend`.
SixPlaces unit_triangle(double bend = 0) {
  SixPlaces out;
  for (std::size_t k = 0; k < 6; ++k) {
    const auto& [u, v] = kNodes[k];
    out[k] = {u, v, bend * (u * u - u * v + 0.5 * v * v)};
  }
  return out;
}

template <typename F>
Vec6 at_nodes(F f) {
  Vec6 out;
  for (std::size_t k = 0; k < 6; ++k) out[static_cast<Eigen::Index>(k)] = f(kNodes[k].first, kNodes[k].second);
  return out;
}

/// Integrals over the part in contact, whichever it is; zero where there is none.
CellIntegrals integrals(const QuadraticCell& cell, const Vec6& p) {
  CellIntegrals some;
  double removed = 0;
  switch (cell.integrate(p, some, removed)) {
    case QuadraticCell::Part::none:
      return {};
    case QuadraticCell::Part::some:
      return some;
    case QuadraticCell::Part::whole:
      return cell.whole();
  }
  return {};
}

TEST(QuadraticCell, QuadraticsAreIntegratedExactly) {
  const QuadraticCell cell(unit_triangle());
  // Over the unit triangle u^a v^b has the integral a! b! / (a + b + 2)!.
  const Vec6 p = at_nodes([](double u, double v) { return 1 + 2 * u + 3 * v + 4 * u * u + 5 * u * v + 6 * v * v; });
  const CellIntegrals got = integrals(cell, p);
  EXPECT_NEAR((got.mass * p).sum(), 0.5 + 5.0 / 6 + 10.0 / 12 + 5.0 / 24, 1e-14);
  EXPECT_NEAR(got.share.sum(), 0.5, 1e-15);
}

TEST(QuadraticCell, LinearPressureIsCutOffExactly) {
  const QuadraticCell cell(unit_triangle());
  for (const double c : {0.1, 0.25, 0.4, 0.77}) {
    // Positive where u > c: a triangle similar to the whole, 1 - c as large.
    const Vec6 p = at_nodes([c](double u, double) { return u - c; });
    const CellIntegrals got = integrals(cell, p);
    EXPECT_NEAR((got.mass * p).sum(), std::pow(1 - c, 3) / 6, 1e-15) << c;
    EXPECT_NEAR(got.share.sum(), std::pow(1 - c, 2) / 2, 1e-14) << c;
  }
}

TEST(QuadraticCell, NothingWhereThePressureIsNegative) {
  CellIntegrals some;
  double removed = 0;
  EXPECT_EQ(QuadraticCell(unit_triangle()).integrate(-Vec6::Ones(), some, removed), QuadraticCell::Part::none);
}

/// The circle u^2 + v^2 < r^2: the load tends to a closed form as the triangle is divided into cells.
TEST(QuadraticCell, ACircleConverges) {
  const double r = 0.6;
  const auto pressure = [r](double u, double v) { return r * r - u * u - v * v; };
  const double exact = M_PI * std::pow(r, 4) / 8;  // a quarter of the paraboloid
  double error[2];
  for (const int n : {4, 16}) {
    double load = 0;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i + j < n; ++i)
        for (const int turn : {1, -1}) {
          if (turn < 0 && i + j + 2 > n) continue;
          const double u0 = (turn > 0 ? i : i + 1.0) / n, v0 = (turn > 0 ? j : j + 1.0) / n, h = turn * 1.0 / n;
          SixPlaces x;
          for (std::size_t k = 0; k < 6; ++k) x[k] = {u0 + h * kNodes[k].first, v0 + h * kNodes[k].second, 0};
          const Vec6 p = at_nodes([&](double u, double v) { return pressure(u0 + h * u, v0 + h * v); });
          load += (integrals(QuadraticCell(x), p).mass * p).sum();
        }
    error[n / 16] = std::abs(load / exact - 1);
  }
  EXPECT_LT(error[0], 1e-4);
  EXPECT_LT(error[1], error[0] / 30) << error[0] << ' ' << error[1];
}

/// The forces' derivatives to the pressures are the mass: across the zero line, and as the cell comes into contact as a
/// whole.
TEST(QuadraticCell, TheMassIsTheDerivative) {
  constexpr double kStep = 1e-6;
  const QuadraticCell cell(unit_triangle(0.3));
  test::RandomPoints random(7);
  int parts = 0;
  for (int trial = 0; trial < 300; ++trial) {
    Vec6 p;
    for (Eigen::Index i = 0; i < 6; ++i) p[i] = random.uniform(-1, 1) + (trial % 3) * 0.5;
    if (trial % 10 == 0) p.array() -= p.minCoeff();  // one node at zero
    const CellIntegrals here = integrals(cell, p);
    parts += here.share.sum() > 0 && here.share.sum() < 0.99 * cell.whole().share.sum() ? 1 : 0;
    for (Eigen::Index j = 0; j < 6; ++j) {
      const Vec6 up = p + kStep * Vec6::Unit(j), down = p - kStep * Vec6::Unit(j);
      const Vec6 slope = (integrals(cell, up).mass * up - integrals(cell, down).mass * down) / (2 * kStep);
      EXPECT_LT((slope - here.mass.col(j)).norm(), 1e-6) << trial << ' ' << j;
    }
  }
  EXPECT_GT(parts, 100);
}

TEST(QuadraticCell, WholeAndCutAgreeWhereOneTurnsIntoTheOther) {
  const QuadraticCell cell(unit_triangle(0.2));
  const auto pressure = [](double lift) { return at_nodes([=](double u, double v) { return u + v * v + lift; }); };
  const Vec6 whole = pressure(1e-9), cut = pressure(-1e-9);
  EXPECT_LT((integrals(cell, whole).mass - integrals(cell, cut).mass).norm(), 1e-8);
}

}  // namespace
}  // namespace genu
