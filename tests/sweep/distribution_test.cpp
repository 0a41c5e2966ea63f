#include "genu/sweep/distribution.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/sweep/normal_quantile.h"

namespace genu {
namespace {

/// Mean and standard deviation by the midpoint rule over its quantiles.
std::pair<double, double> moments_of(const Distribution& d) {
  constexpr int kParts = 200000;
  double mean = 0, square = 0;
  for (int k = 0; k < kParts; ++k) {
    const double x = d.quantile((k + 0.5) / kParts);
    mean += x / kParts, square += x * x / kParts;
  }
  return {mean, std::sqrt(square - mean * mean)};
}

TEST(Distribution, NormalHasItsMoments) {
  Distribution d;
  d.kind = Distribution::Kind::normal;
  d.mean = 3, d.sd = 0.5;
  EXPECT_EQ(d.quantile(0.5), 3);
  const auto [mean, sd] = moments_of(d);
  EXPECT_NEAR(mean, 3, 1e-6);
  EXPECT_NEAR(sd, 0.5, 1e-4);
  EXPECT_NEAR(d.smallest(), 3 - 0.5 * 8.2, 0.05);
}

TEST(Distribution, LognormalHasTheMomentsOfTheNumberItself) {
  const auto [mean, sd] = moments_of(lognormal(2, 0.6));
  EXPECT_NEAR(mean, 2, 1e-4);
  EXPECT_NEAR(sd, 0.6, 1e-3);
  EXPECT_GT(lognormal(2, 0.6).smallest(), 0);
}

TEST(Distribution, TruncatedStaysInItsRangeWithTheSameDensity) {
  Distribution d;
  d.kind = Distribution::Kind::normal;
  d.low = 0.5, d.high = 2;
  EXPECT_NEAR(d.quantile(1e-12), 0.5, 1e-9);
  EXPECT_NEAR(d.quantile(1 - 1e-12), 2, 1e-9);
  const double a = normal_probability(0.5), b = normal_probability(2);
  EXPECT_NEAR(d.quantile(0.3), normal_quantile(a + 0.3 * (b - a)), 1e-13);
  d.low = 20, d.high = 21;  // far in a tail, where probabilities near 1 have no digits
  EXPECT_GT(d.quantile(0.5), 20);
  EXPECT_LT(d.quantile(0.5), d.quantile(0.9));
  EXPECT_LT(d.quantile(0.9), 21);
}

TEST(Distribution, ValuesComeAsOftenAsTheirWeights) {
  Distribution d;
  d.kind = Distribution::Kind::values;
  d.values = {5, -1, 2}, d.weights = {1, 2, 1};
  int count = 0;
  for (int k = 0; k < 1000; ++k) count += d.quantile((k + 0.5) / 1000) == -1 ? 1 : 0;
  EXPECT_EQ(count, 500);
  EXPECT_EQ(d.smallest(), -1);
}

}  // namespace
}  // namespace genu
