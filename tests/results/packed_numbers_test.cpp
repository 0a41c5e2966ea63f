#include "genu/results/packed_numbers.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(PackedNumbers, AreBase64OfTheirBytes) {
  // RFC 4648, section 10, as the halves of 16-bit words: "fo", "foob", "foobar".
  EXPECT_EQ(packed(std::vector<std::uint16_t>{0x6f66}), "Zm8=");
  EXPECT_EQ(packed(std::vector<std::uint16_t>{0x6f66, 0x626f}), "Zm9vYg==");
  EXPECT_EQ(packed(std::vector<std::uint16_t>{0x6f66, 0x626f, 0x7261}), "Zm9vYmFy");
  EXPECT_EQ(packed(std::vector<std::uint32_t>{0xffffffff}), "/////w==");
  EXPECT_EQ(packed(std::vector<float>{1.0f}), "AACAPw==");  // 3f800000, the least byte first
  EXPECT_EQ(packed(std::vector<float>()), "");
}

TEST(PackedNumbers, WhatIsNoNumberStaysNone) {
  const double infinity = std::numeric_limits<double>::infinity(), none = std::nan("");
  EXPECT_EQ(packed_floats({none}), packed_floats({-infinity}));
  EXPECT_EQ(packed_floats({none}), packed(std::vector<float>{std::numeric_limits<float>::quiet_NaN()}));
  EXPECT_EQ(packed_floats({2.0}), packed(std::vector<float>{2.0f}));
}

TEST(PackedNumbers, PointsLieOnAGridOverTheirBox) {
  const PackedPoints p = packed_points({{-1, 0, 5}, {3, 2, 5}, {1, 1, 5}});
  EXPECT_EQ(p.low, Vec3(-1, 0, 5));
  EXPECT_DOUBLE_EQ(p.step, 4.0 / 65535);
  EXPECT_EQ(p.integers, packed(std::vector<std::uint16_t>{0, 0, 0, 65535, 32768, 0, 32768, 16384, 0}));
  EXPECT_EQ(packed_points({{7, 7, 7}}).integers, packed(std::vector<std::uint16_t>{0, 0, 0}));
  EXPECT_EQ(packed_points({}).integers, "");
}

}  // namespace
}  // namespace genu
