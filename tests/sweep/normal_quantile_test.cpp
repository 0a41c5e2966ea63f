#include "genu/sweep/normal_quantile.h"

#include <cmath>

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(NormalQuantile, GivesTheTablesValues) {
  EXPECT_NEAR(normal_quantile(0.5), 0, 1e-16);
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-14);
  EXPECT_NEAR(normal_quantile(0.001), -3.090232306167813, 1e-14);
  EXPECT_NEAR(normal_quantile(1e-20), -9.262340089798408, 1e-13);
}

TEST(NormalQuantile, InvertsTheProbability) {
  double worst = 0;
  for (double z = -8; z <= 2; z += 0.01) worst = std::max(worst, std::abs(normal_quantile(normal_probability(z)) - z));
  EXPECT_LT(worst, 1e-13);
}

}  // namespace
}  // namespace genu
