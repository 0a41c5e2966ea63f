#include "genu/study/accuracy_trials.h"

#include <cmath>

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(AccuracyTrials, SpreadIsOfTheMiddleHalf) {
  EXPECT_TRUE(std::isnan(median({})));
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(spread({}), 0);
  EXPECT_EQ(spread({5}), 0);
  EXPECT_DOUBLE_EQ(spread({1, 2}), 0.5);
  EXPECT_DOUBLE_EQ(spread({1, 2, 4}), 1.5);
  EXPECT_DOUBLE_EQ(spread({100, 2, 2, 2, 2}), 0) << "one round that was disturbed says nothing";
  EXPECT_DOUBLE_EQ(spread({1, 2, 1, 2, 1, 2}), 0.5) << "fast and slow in turn: no one can tell";
}

}  // namespace
}  // namespace genu
