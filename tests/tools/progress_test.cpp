#include "cli/progress.h"

#include <gtest/gtest.h>

#include "cli/colour.h"

namespace genu::cli {
namespace {

TEST(Progress, PercentAndTimeLeft) {
  EXPECT_EQ(progress_text(25, 100, 3), ", 25 %, 3 s, about 9 s left");
  EXPECT_EQ(progress_text(1, 1000, 1), ", 0 %, 1 s, about 17 min left");
  EXPECT_EQ(progress_text(1, 100'000, 2), ", 0 %, 2 s, about 56 h left");
  EXPECT_EQ(progress_text(100, 100, 4), ", 100 %, 4 s");
  EXPECT_EQ(progress_text(0, 100, 4), ", 0 %, 4 s");
  EXPECT_EQ(progress_text(3, 0, 4), ", 4 s");  // how many is not known
}

TEST(Colour, NoneWhereThereIsNoTerminal) { EXPECT_EQ(painted("word", Colour::red, -1), "word"); }

}  // namespace
}  // namespace genu::cli
