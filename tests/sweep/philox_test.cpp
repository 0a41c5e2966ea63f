#include "genu/sweep/philox.h"

#include <set>

#include <gtest/gtest.h>

namespace genu {
namespace {

// Random123, tests/kat_vectors: philox4x32, 10 rounds.
TEST(Philox, GivesThePublishedAnswers) {
  constexpr std::uint32_t kOnes = 0xffffffff;
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (PhiloxBlock{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}),
            (PhiloxBlock{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (PhiloxBlock{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(RandomBits, DifferWithEveryArgument) {
  const std::set<std::uint64_t> all = {random_bits(1, 2, 3, DrawPurpose::coordinate),
                                       random_bits(2, 2, 3, DrawPurpose::coordinate),
                                       random_bits(1, 3, 3, DrawPurpose::coordinate),
                                       random_bits(1, 2, 4, DrawPurpose::coordinate),
                                       random_bits(1, 2, 3, DrawPurpose::stratum),
                                       random_bits(1 + (std::uint64_t{1} << 32), 2, 3, DrawPurpose::coordinate),
                                       random_bits(1, 2 + (std::uint64_t{1} << 32), 3, DrawPurpose::coordinate)};
  EXPECT_EQ(all.size(), 7u);
}

TEST(OpenUnit, NeverReachesItsEnds) {
  EXPECT_EQ(open_unit(0), 0x1p-53);
  EXPECT_EQ(open_unit(~std::uint64_t{0}), 1 - 0x1p-53);
}

}  // namespace
}  // namespace genu
