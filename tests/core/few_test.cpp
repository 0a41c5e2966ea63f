#include "genu/core/few.h"

#include <gtest/gtest.h>

#include "genu/core/types.h"

namespace genu {
namespace {

TEST(Few, HoldsWhatItIsGivenInOrder) {
  Few<Vec3, 3> few;
  EXPECT_TRUE(few.empty());
  few.push_back({1, 2, 3});
  few.push_back({4, 5, 6});
  EXPECT_FALSE(few.full());
  few.push_back({7, 8, 9});
  EXPECT_TRUE(few.full());
  EXPECT_EQ(few[1], Vec3(4, 5, 6));
  Vec3 sum = Vec3::Zero();
  for (const Vec3& v : few) sum += v;
  EXPECT_EQ(sum, Vec3(12, 15, 18));
}

TEST(Few, CopiesAreTheirOwn) {
  Few<int, 4> few;
  few.push_back(1);
  few.push_back(2);
  Few<int, 4> copy = few;
  copy[0] = 5;
  EXPECT_EQ(few[0], 1);
  copy.push_back(3);
  few = copy;
  ASSERT_EQ(few.size(), 3u);
  EXPECT_EQ(few[0], 5);
  EXPECT_EQ(few[2], 3);
}

TEST(Few, GrowsWithDefaultValuesAndShrinks) {
  struct Counted {
    int value = 7;
  };
  Few<Counted, 5> few(2);
  few[0].value = 1;
  few.resize(4);
  EXPECT_EQ(few[0].value, 1);
  EXPECT_EQ(few[3].value, 7);
  few.resize(1);
  EXPECT_EQ(few.size(), 1u);
  EXPECT_EQ(std::span<const Counted>(few).size(), 1u);
}

}  // namespace
}  // namespace genu
