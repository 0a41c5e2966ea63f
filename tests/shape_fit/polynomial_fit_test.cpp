#include "genu/shape_fit/polynomial_fit.h"

#include <cmath>
#include <cstdio>
#include <random>

#include <gtest/gtest.h>

#include "genu/surface/polynomial_surface.h"

namespace genu {
namespace {

const ChartBox kBox{-0.02, 0.014, -0.011, 0.013};

/// Samples of f all over the box, jittered off any grid.
template <class F>
std::vector<HeightSample> samples_of(int across, const F& f) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> jitter(0, 1);
  std::vector<HeightSample> out;
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = kBox.u0 + kBox.width() * (i + jitter(random)) / across,
                   v = kBox.v0 + kBox.height() * (j + jitter(random)) / across;
      out.push_back({u, v, f(u, v), 0.5 + jitter(random)});
    }
  return out;
}

TEST(PolynomialFit, GivesAPolynomialBackAtEveryDegree) {
  for (int degree = 1; degree <= kHighestFitDegree; ++degree) {
    std::mt19937 random(static_cast<unsigned>(degree));
    std::uniform_real_distribution<double> any(-1, 1);
    std::vector<PolynomialTerm> terms;
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; i + j <= degree; ++j)
        terms.push_back({i, j, 0.01 * any(random) * std::pow(0.02, -i) * std::pow(0.013, -j)});
    const Polynomial P(terms);
    const auto samples = samples_of(40, [&](double u, double v) { return P.value(u, v); });
    const PolynomialFit fit(samples, kBox, degree);
    ASSERT_EQ(fit.highest(), degree);
    const Polynomial back(fit.terms(degree));
    double worst = 0;
    for (const HeightSample& s : samples) worst = std::max(worst, std::abs(back.value(s.u, s.v) - s.h));
    std::printf("degree %2d: off by %.1e m of 0.1 m\n", degree, worst);
    EXPECT_LT(worst, 1e-11);
  }
}

TEST(PolynomialFit, DegreesShareOneFactorisation) {
  const auto samples = samples_of(30, [](double u, double v) { return std::sin(80 * u) * std::cos(90 * v); });
  const PolynomialFit all(samples, kBox, 8), alone(samples, kBox, 3);
  const Polynomial a(all.terms(3)), b(alone.terms(3));
  for (const HeightSample& s : samples) EXPECT_NEAR(a.value(s.u, s.v), b.value(s.u, s.v), 1e-12);
  EXPECT_NEAR(all.rms(3), alone.rms(3), 1e-14);
}

TEST(PolynomialFit, TooFewOrDegenerateSamplesLowerTheDegree) {
  const auto few = samples_of(4, [](double u, double) { return u; });
  EXPECT_EQ(PolynomialFit(few, kBox, 9).highest(), 1);  // 16 samples, 3 for each of 3 coefficients
  std::vector<HeightSample> line = samples_of(20, [](double u, double) { return u; });
  for (HeightSample& s : line) s.v = 0.001;
  EXPECT_EQ(PolynomialFit(line, kBox, 4).highest(), 0);  // nothing says how it changes with v
  const std::vector<HeightSample> none, one(1);
  for (const auto* samples : {&none, &one}) {
    const PolynomialFit fit(*samples, kBox, 4);
    EXPECT_EQ(fit.highest(), -1);
    EXPECT_TRUE(fit.scores(0, 0.004, 0.004).empty());  // nothing to leave out
  }
}

TEST(PolynomialFit, LeftOutErrorIsThatOfRefitsWithoutTheFold) {
  const auto samples = samples_of(30, [](double u, double v) { return std::exp(30 * u) * std::cos(100 * v); });
  const PolynomialFit fit(samples, kBox, 4);
  const double block_u = kBox.width() / 5, block_v = kBox.height() / 2;
  const auto scores = fit.scores(2, block_u, block_v);
  for (const DegreeScore& score : scores) {  // the plain twin: ten fits from scratch
    double square = 0, weight = 0;
    for (int fold = 0; fold < 10; ++fold) {
      std::vector<HeightSample> in, out;
      for (const HeightSample& s : samples) {
        const auto column = static_cast<int>((s.u - kBox.u0) / block_u),
                   row = static_cast<int>((s.v - kBox.v0) / block_v);
        ((column + 3 * row) % 10 == fold ? out : in).push_back(s);
      }
      const PolynomialFit without(in, kBox, score.degree);
      const Polynomial P(without.terms(score.degree));
      for (const HeightSample& s : out) {
        square += s.weight * std::pow(P.value(s.u, s.v) - s.h, 2);
        weight += s.weight;
      }
    }
    EXPECT_NEAR(score.left_out_rms / std::sqrt(square / weight), 1, 1e-6) << score.degree;
  }
}

/// Noise that neighbours share, as a segmentation's: a field of bumps 3 mm wide.
double correlated(double u, double v) {
  double sum = 0;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int k = 0; k < 200; ++k) {
    const double x = kBox.u0 + kBox.width() * 0.5 * (1 + any(random)),
                 y = kBox.v0 + kBox.height() * 0.5 * (1 + any(random)), a = any(random);
    sum += a * std::exp(-(std::pow(u - x, 2) + std::pow(v - y, 2)) / (2 * 0.0015 * 0.0015));
  }
  return 5e-5 * sum;
}

TEST(PolynomialFit, CorrelatedNoiseDoesNotRaiseTheDegree) {
  const Polynomial shape({{2, 0, 10}, {0, 2, 15}, {2, 1, 150}, {3, 0, -200}});
  const auto samples = samples_of(40, [&](double u, double v) { return shape.value(u, v) + correlated(u, v); });
  const PolynomialFit fit(samples, kBox, 10);
  const int by_blocks = choose_degree(fit.scores(2, 0.005, 0.005), 0),
            by_points = choose_degree(fit.scores(2, 0.0002, 0.0002), 0);
  std::printf("a cubic under correlated noise: degree %d by blocks, %d by single samples\n", by_blocks, by_points);
  EXPECT_LE(by_blocks, 5);
  EXPECT_GT(by_points, by_blocks);
}

TEST(PolynomialFit, ChoosesTheLowestDegreeThatIsAsGood) {
  EXPECT_EQ(choose_degree({{2, 1.0, 0}, {3, 0.50, 0}, {4, 0.49, 0}, {5, 0.7, 0}}, 0), 3);
  EXPECT_EQ(choose_degree({{2, 1e-3, 0}, {3, 3e-9, 0}, {4, 1e-9, 0}}, 2e-9), 3);
  EXPECT_EQ(choose_degree({}, 0), -1);
}

TEST(PolynomialFit, ExactDegreeIsTheLowestThatLeavesRounding) {
  for (const double rounding : {0.0, 2e-9}) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> off(-rounding, rounding);
    const Polynomial P({{2, 0, 10}, {0, 2, 15}, {2, 3, 2e5}});
    auto samples = samples_of(40, [&](double u, double v) { return P.value(u, v); });
    for (HeightSample& s : samples) s.h += off(random);
    EXPECT_EQ(exact_degree(PolynomialFit(samples, kBox, 12), 4e-9), 5);
    EXPECT_EQ(exact_degree(PolynomialFit(samples, kBox, 4), 4e-9), -1);
  }
  EXPECT_EQ(exact_degree(PolynomialFit({}, kBox, 4), 1), -1);
}

}  // namespace
}  // namespace genu
