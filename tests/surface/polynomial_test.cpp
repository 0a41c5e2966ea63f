#include "genu/surface/polynomial.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

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

/// Horner's rule as it is written down, power after power: the plain twin.
PolynomialJet horner(const std::vector<PolynomialTerm>& terms, double x, double y) {
  PolynomialJet r;
  int degree = 0;
  for (const PolynomialTerm& t : terms) degree = std::max({degree, t.i, t.j});
  for (int i = degree; i >= 0; --i) {
    double q = 0, q1 = 0, q2 = 0;
    for (int j = degree; j >= 0; --j) {
      double c = 0;
      for (const PolynomialTerm& t : terms)
        if (t.i == i && t.j == j) c += t.c;
      q2 = q2 * y + q1;
      q1 = q1 * y + q;
      q = q * y + c;
    }
    r.xx = r.xx * x + 2 * r.x;
    r.xy = r.xy * x + r.y;
    r.x = r.x * x + r.f;
    r.yy = r.yy * x + 2 * q2;
    r.y = r.y * x + q1;
    r.f = r.f * x + q;
  }
  return r;
}

void expect_same_bits(const PolynomialJet& a, const PolynomialJet& b) {
  EXPECT_EQ(a.f, b.f);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.y, b.y);
  EXPECT_EQ(a.xx, b.xx);
  EXPECT_EQ(a.xy, b.xy);
  EXPECT_EQ(a.yy, b.yy);
}

TEST(Polynomial, FourPowersAtATimeAreHornersRuleToTheLastBit) {
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> in(-2, 2);
  for (int degree = 0; degree <= 12; ++degree) {
    std::vector<PolynomialTerm> terms;
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; i + j <= degree; ++j)
        if (const double c = in(engine); c > -1.2) terms.push_back({i, j, c});
    terms.push_back({degree, 0, 0.25});
    const Polynomial P(terms);
    for (int k = 0; k < 50; ++k) {
      const double x = in(engine);
      const double y = in(engine);
      expect_same_bits(P(x, y), horner(terms, x, y));
      expect_same_bits(P(x, y), P.jet_anywhere(x, y));
      EXPECT_EQ(P.value(x, y), P(x, y).f);
    }
  }
}

}  // namespace
}  // namespace genu
