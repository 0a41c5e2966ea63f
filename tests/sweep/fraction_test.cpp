#include "genu/sweep/fraction.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

/// The least number of words that add up to nothing, up to `most`.
int resolution_of(const std::vector<std::uint32_t>& words, int most, std::size_t from = 0, std::uint32_t sum = 0,
                  int count = 0) {
  int least = most + 1;
  for (std::size_t k = from; k < words.size() && count < most; ++k) {
    const std::uint32_t next = sum ^ words[k];
    least = std::min(least, next == 0 ? count + 1 : resolution_of(words, most, k + 1, next, count + 1));
  }
  return least;
}

TEST(Fraction, HasItsResolutionAndAsFewSamplesAsTheTables) {
  // Box, Hunter and Hunter's table of 2^(k-p) designs: k factors, resolution, samples.
  struct Known {
    std::size_t factors;
    int resolution, bits;
  };
  for (const Known& known : {Known{3, 3, 2}, Known{7, 3, 3}, Known{15, 3, 4}, Known{4, 4, 3}, Known{8, 4, 4},
                             Known{16, 4, 5}, Known{5, 5, 4}, Known{6, 5, 5}, Known{8, 5, 6}, Known{1, 4, 1}}) {
    const auto fraction = find_fraction(known.factors, known.resolution);
    ASSERT_TRUE(fraction);
    EXPECT_EQ(fraction->bits, known.bits) << known.factors << " factors, resolution " << known.resolution;
    EXPECT_EQ(fraction->words.size(), known.factors);
    EXPECT_GE(resolution_of(fraction->words, known.resolution), known.resolution);
  }
  EXPECT_FALSE(find_fraction(500, 5));
}

TEST(Fraction, HasEveryPairOfLevelsEquallyOften) {
  const auto fraction = find_fraction(7, 3);
  ASSERT_TRUE(fraction);
  for (std::size_t a = 0; a < 7; ++a)
    for (std::size_t b = a + 1; b < 7; ++b) {
      int counts[2][2] = {};
      for (std::uint64_t s = 0; s < 8; ++s)
        ++counts[second_level(fraction->words[a], s) ? 1 : 0][second_level(fraction->words[b], s) ? 1 : 0];
      for (const auto& row : counts)
        for (const int n : row) EXPECT_EQ(n, 2);
    }
}

}  // namespace
}  // namespace genu
