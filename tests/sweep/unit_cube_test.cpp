#include "genu/sweep/unit_cube.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "genu/sweep/distribution.h"
#include "genu/sweep/sobol_numbers.h"

namespace genu {
namespace {

TEST(Permuted, IsAPermutationOfAnyCount) {
  for (const std::uint64_t count : {1u, 2u, 3u, 7u, 64u, 1000u}) {
    std::vector<int> seen(count);
    for (std::uint64_t i = 0; i < count; ++i) ++seen[permuted(5, i, 2, count)];
    for (const int times : seen) EXPECT_EQ(times, 1) << count;
  }
}

TEST(Permuted, SendsEveryPlaceAnywhere) {
  // Over seeds each of five places comes up about a fifth of the time: 4 standard errors.
  constexpr int kSeeds = 4000, kCount = 5;
  std::vector<int> seen(kCount);
  for (int seed = 0; seed < kSeeds; ++seed) ++seen[permuted(static_cast<std::uint64_t>(seed), 3, 0, kCount)];
  const double expected = kSeeds / static_cast<double>(kCount), error = std::sqrt(expected * (1 - 1.0 / kCount));
  for (const int times : seen) EXPECT_NEAR(times, expected, 4 * error);
}

TEST(LatinHypercube, HasOnePointInEachStratum) {
  constexpr std::uint64_t kCount = 37;
  for (std::uint32_t d = 0; d < 3; ++d) {
    std::vector<int> seen(kCount);
    for (std::uint64_t i = 0; i < kCount; ++i)
      ++seen[static_cast<std::size_t>(kCount * latin_hypercube_coordinate(9, i, d, kCount))];
    for (const int times : seen) EXPECT_EQ(times, 1);
  }
}

TEST(InsideUnit, LeavesEveryCoordinateAQuantile) {
  // The last of 1e8 strata and a uniform number of 1 - 2^-30 round up to 1, the first Sobol digits to 2^-85.
  Distribution normal;
  normal.kind = Distribution::Kind::normal;
  const double last = (99'999'999.0 + (1 - 0x1p-30)) / 1e8;
  EXPECT_EQ(last, 1);
  EXPECT_TRUE(std::isfinite(normal.quantile(inside_unit(last))));
  EXPECT_GT(normal.quantile(inside_unit(last)), 8);
  EXPECT_EQ(normal.quantile(inside_unit(0x1p-85)), normal.smallest());
  EXPECT_EQ(inside_unit(0.25), 0.25);
}

TEST(MonteCarlo, IsUniformAndIndependent) {
  constexpr int kCount = 20000;
  double x = 0, xx = 0, xy = 0;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const double u = monte_carlo_coordinate(3, i, 0), v = monte_carlo_coordinate(3, i, 1);
    x += u / kCount, xx += u * u / kCount, xy += u * v / kCount;
  }
  const double error = 1 / std::sqrt(12.0 * kCount);
  EXPECT_NEAR(x, 0.5, 4 * error);
  EXPECT_NEAR(xx, 1 / 3.0, 4 * error);
  EXPECT_NEAR(xy, 0.25, 4 * error);
}

// Joe and Kuo's own program, first points of the first six dimensions (in the order of the index, not of Gray's code).
TEST(Sobol, HasThePublishedPoints) {
  const SobolSequence sobol(1, 6);
  const double expected[8][6] = {{0, 0, 0, 0, 0, 0},
                                 {.5, .5, .5, .5, .5, .5},
                                 {.25, .75, .75, .75, .25, .25},
                                 {.75, .25, .25, .25, .75, .75},
                                 {.125, .625, .375, .125, .125, .375},
                                 {.625, .125, .875, .625, .625, .875},
                                 {.375, .375, .625, .875, .375, .125},
                                 {.875, .875, .125, .375, .875, .625}};
  for (std::uint64_t i = 0; i < 8; ++i)
    for (std::uint32_t d = 0; d < 6; ++d) EXPECT_EQ(sobol.digits(i, d) * 0x1p-32, expected[i][d]) << i << " " << d;
}

TEST(Sobol, ScrambledPointsFillEveryDyadicInterval) {
  constexpr std::uint64_t kCount = 256;
  const SobolSequence sobol(11, kMaxSobolDimensions);
  for (std::uint32_t d = 0; d < kMaxSobolDimensions; ++d) {
    std::vector<int> seen(kCount);
    for (std::uint64_t i = 0; i < kCount; ++i) ++seen[static_cast<std::size_t>(kCount * sobol.coordinate(i, d))];
    for (const int times : seen) EXPECT_EQ(times, 1) << d;
  }
}

TEST(Sobol, ScrambledPointsAreANetInTwoDimensions) {
  // The first two dimensions are a (0, m, 2)-net: one of 256 points in each of 16 x 16 boxes.
  const SobolSequence sobol(4, 2);
  std::vector<int> seen(256);
  for (std::uint64_t i = 0; i < 256; ++i) {
    const auto a = static_cast<std::size_t>(16 * sobol.coordinate(i, 0));
    ++seen[16 * a + static_cast<std::size_t>(16 * sobol.coordinate(i, 1))];
  }
  for (const int times : seen) EXPECT_EQ(times, 1);
}

TEST(Sobol, IntegratesBetterThanMonteCarlo) {
  // The mean of a product of five factors with mean 1, over seeds: root mean square error of 1024 points.
  const auto error = [](bool sobol_points) {
    double square = 0;
    constexpr int kSeeds = 20;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
      const SobolSequence sobol(seed, 5);
      double mean = 0;
      for (std::uint64_t i = 0; i < 1024; ++i) {
        double f = 1;
        for (std::uint32_t d = 0; d < 5; ++d)
          f *= 0.5 + (sobol_points ? sobol.coordinate(i, d) : monte_carlo_coordinate(seed, i, d));
        mean += f / 1024;
      }
      square += (mean - 1) * (mean - 1) / kSeeds;
    }
    return std::sqrt(square);
  };
  EXPECT_LT(error(true), 0.1 * error(false));
}

}  // namespace
}  // namespace genu
