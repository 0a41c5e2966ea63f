#include "genu/sweep/statistics.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "genu/sweep/normal_quantile.h"
#include "genu/sweep/unit_cube.h"

namespace genu {
namespace {

TEST(Moments, LeaveOutWhatIsNoNumber) {
  const Moments m = moments({1, kNoNumber, 2, 3, 4});
  EXPECT_EQ(m.count, 4u);
  EXPECT_EQ(m.mean, 2.5);
  EXPECT_NEAR(m.sd, std::sqrt(5 / 3.0), 1e-15);
  EXPECT_TRUE(std::isnan(moments({}).mean));
  EXPECT_TRUE(std::isnan(moments({1}).sd));
}

TEST(Quantile, IsLinearBetweenOrderStatistics) {
  const std::vector<double> v = {1, 2, 4, 8};
  EXPECT_EQ(quantile(v, 0), 1);
  EXPECT_EQ(quantile(v, 0.5), 3);
  EXPECT_EQ(quantile(v, 0.75), 5);  // numpy.percentile([1, 2, 4, 8], 75)
  EXPECT_EQ(quantile(v, 1), 8);
}

TEST(QuantileInterval, CoversTheTruthAboutAsOftenAsItSays) {
  // 400 samples of 200 normal numbers; coverage of 95 % within 4 standard errors, or above (ranks are whole numbers).
  for (const double q : {0.1, 0.5, 0.9}) {
    int covered = 0;
    constexpr int kTimes = 400;
    for (std::uint64_t t = 0; t < kTimes; ++t) {
      std::vector<double> v;
      for (std::uint64_t i = 0; i < 200; ++i) v.push_back(normal_quantile(monte_carlo_coordinate(t, i, 0)));
      std::sort(v.begin(), v.end());
      const Interval interval = quantile_interval(v, q);
      covered += interval.low <= normal_quantile(q) && normal_quantile(q) <= interval.high ? 1 : 0;
    }
    EXPECT_GE(covered, kTimes * 0.95 - 4 * std::sqrt(kTimes * 0.95 * 0.05)) << q;
    EXPECT_LE(covered, kTimes * 0.99) << q;
  }
  EXPECT_TRUE(std::isnan(quantile_interval({1, 2, 3}, 0.95).high));
}

TEST(ProbabilityInterval, IsWilsons) {
  // Its ends are where a normal test of the probability q rejects: |p - q| = 1.96 sqrt(q (1 - q) / n).
  const Interval i = probability_interval(10, 100);
  for (const double q : {i.low, i.high})
    EXPECT_NEAR(std::abs(0.1 - q), 1.959963984540054 * std::sqrt(q * (1 - q) / 100), 1e-15);
  EXPECT_LT(i.low, 0.1);
  EXPECT_EQ(probability_interval(0, 10).low, 0);
  EXPECT_EQ(probability_interval(10, 10).high, 1);
}

TEST(RankCorrelation, GivesEqualNumbersTheirMeanRank) {
  // numpy.corrcoef of the ranks [1, 2.5, 2.5, 4, 5] and [2, 1, 3, 4.5, 4.5].
  EXPECT_NEAR(rank_correlation(Ordered({1, 2, 2, 4, 5}), Ordered({5, 3, 6, 7, 7})), 0.7894736842105264, 1e-15);
  EXPECT_EQ(rank_correlation(Ordered({1, 2, 3, kNoNumber}), Ordered({1, 8, 27, 0})), 1);
  EXPECT_EQ(rank_correlation(Ordered({4, 3, 2, 9, 1}), Ordered({1, 2, 3, kNoNumber, 4})), -1);
  EXPECT_TRUE(std::isnan(rank_correlation(Ordered({1, 1, 1}), Ordered({1, 2, 3}))));
}

/// Spearman's correlation of a bivariate normal distribution with Pearson's r.
double spearman_of(double r) { return 6 / M_PI * std::asin(r / 2); }

TEST(RankCorrelationInterval, CoversTheTruthAsOftenAsItSays) {
  // 1000 samples of 100 pairs; coverage of 95 % within 4 standard errors, also where Fisher's own variance covers 90 %.
  constexpr int kTimes = 1000;
  const double error = std::sqrt(kTimes * 0.95 * 0.05);
  for (const double r : {0.0, 0.8, 0.95}) {
    int covered = 0;
    for (std::uint64_t t = 0; t < kTimes; ++t) {
      std::vector<double> x, y;
      for (std::uint64_t i = 0; i < 100; ++i) {
        x.push_back(normal_quantile(monte_carlo_coordinate(t, i, 0)));
        y.push_back(r * x.back() + std::sqrt(1 - r * r) * normal_quantile(monte_carlo_coordinate(t, i, 1)));
      }
      const Interval interval = rank_correlation_interval(rank_correlation(Ordered(x), Ordered(y)), 100);
      covered += interval.low <= spearman_of(r) && spearman_of(r) <= interval.high ? 1 : 0;
    }
    EXPECT_NEAR(covered, kTimes * 0.95, 4 * error) << r;
  }
}

TEST(SobolIndices, AreThoseOfIshigamisFunction) {
  // sin x1 + 7 sin^2 x2 + 0.1 x3^4 sin x1 on [-pi, pi]^3: first 0.3139, 0.4424, 0; total 0.5576, 0.4424, 0.2437.
  const auto f = [](const std::array<double, 3>& u) {
    const auto x = [&](std::size_t k) { return M_PI * (2 * u[k] - 1); };
    return std::sin(x(0)) + 7 * std::pow(std::sin(x(1)), 2) + 0.1 * std::pow(x(2), 4) * std::sin(x(0));
  };
  const SobolSequence sobol(3, 6);
  std::vector<double> values;
  for (std::uint64_t i = 0; i < 4096; ++i) {
    std::array<double, 3> a{}, b{};
    for (std::uint32_t d = 0; d < 3; ++d) a[d] = sobol.coordinate(i, d), b[d] = sobol.coordinate(i, 3 + d);
    values.insert(values.end(), {f(a), f(b)});
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<double, 3> ab = a;
      ab[k] = b[k];
      values.push_back(f(ab));
    }
  }
  values[2] = kNoNumber;  // one block less
  const auto indices = sobol_indices(values, 3);
  const double first[] = {0.3139, 0.4424, 0}, total[] = {0.5576, 0.4424, 0.2437};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(indices[k].blocks, 4095u);
    EXPECT_NEAR(indices[k].first, first[k], 0.01);
    EXPECT_NEAR(indices[k].total, total[k], 0.01);
    EXPECT_LT(indices[k].first_error, 0.05);
  }
}

}  // namespace
}  // namespace genu
