#include "genu/results/error_bars.h"

#include <cmath>

#include <gtest/gtest.h>

namespace genu {
namespace {

/// Five poses; x is `off` away from row * 1 mm everywhere, and `peak` more in row 2. Row `unsolved` is not, nor are
/// those from row `lost` on; from row `open` on x is empty.
ResultTable poses(double off, double peak = 0, int unsolved = -1, int lost = 5, int open = 5) {
  ResultTable t;
  for (const char* column : {"step", "increment", "status", "knee.x_mm", "ACL.strain", "newton.iterations"})
    t.add_column(column);
  for (long row = 0; row < 5; ++row) {
    t.add_row();
    t.set("step", 1L);
    t.set("increment", row);
    const bool ok = row != unsolved && row < lost;
    t.set("status", std::string(ok ? "ok" : "no_equilibrium"));
    if (!ok) continue;
    if (row < open) t.set("knee.x_mm", static_cast<double>(row) + off + (row == 2 ? peak : 0));
    t.set("ACL.strain", 0.01);
    t.set("newton.iterations", row);
  }
  return t;
}

TEST(ErrorBars, SharesAreTheLargestFitTwiceTheRmsOfNoiseAndTwiceWhatACoarserMeshChanges) {
  const ResultTable base = poses(0), fit_1 = poses(0.3), fit_2 = poses(-0.4), noise_1 = poses(0.1),
                    noise_2 = poses(-0.7), coarse = poses(0.2);
  const ErrorBars out = error_bars(base, {{ErrorCause::fit, &fit_1},
                                          {ErrorCause::fit, &fit_2},
                                          {ErrorCause::noise, &noise_1},
                                          {ErrorCause::noise, &noise_2},
                                          {ErrorCause::mesh, &coarse}});
  ASSERT_EQ(out.bars.rows(), 5u);
  for (std::size_t row = 0; row < 5; ++row) {
    EXPECT_NEAR(out.bars.number(row, "knee.x_mm"), std::sqrt(0.16 + 4 * 0.25 + 0.16), 1e-14);
    EXPECT_EQ(out.bars.number(row, "ACL.strain"), 0);
    EXPECT_EQ(out.bars.number(row, "variants"), 5);
  }
  EXPECT_FALSE(out.bars.has_column("newton.iterations"));
  ASSERT_EQ(out.shares.rows(), 10u);
  EXPECT_EQ(std::get<std::string>(out.shares.at(0, out.shares.column_index("output"))), "knee.x_mm");
  EXPECT_NEAR(out.shares.number(0, "fit"), 0.4, 1e-15);
  EXPECT_NEAR(out.shares.number(0, "noise"), 1, 1e-15);
  EXPECT_NEAR(out.shares.number(0, "mesh"), 0.4, 1e-15);
  ASSERT_EQ(out.largest.size(), 2u);
  EXPECT_EQ(out.largest[0].cause, ErrorCause::noise);
  EXPECT_NEAR(out.largest[0].median, out.largest[0].largest, 1e-15);
}

TEST(ErrorBars, APeakReachesTheRowsBesideIt) {
  const ResultTable base = poses(0), fit = poses(0.1, 1);
  const ErrorBars out = error_bars(base, {{ErrorCause::fit, &fit}});
  for (std::size_t row = 0; row < 5; ++row)
    EXPECT_NEAR(out.bars.number(row, "knee.x_mm"), row == 0 || row == 4 ? 0.1 : 1.1, 1e-15) << row;
  EXPECT_EQ(out.largest[0].row, 1u) << "the first row of the largest bar";
}

TEST(ErrorBars, WhatIsNotSolvedHasNoBarAndCountsForNone) {
  const ResultTable base = poses(0, 0, 1), fit_1 = poses(0.5, 0, 3), fit_2 = poses(0.25);
  const ErrorBars out = error_bars(base, {{ErrorCause::fit, &fit_1}, {ErrorCause::fit, &fit_2}});
  EXPECT_TRUE(std::isnan(out.bars.number(1, "knee.x_mm")));
  EXPECT_EQ(out.bars.number(1, "variants"), 0);
  EXPECT_EQ(out.bars.number(3, "variants"), 1);
  EXPECT_NEAR(out.bars.number(0, "knee.x_mm"), 0.5, 1e-15);
  EXPECT_NEAR(out.bars.number(3, "knee.x_mm"), 0.5, 1e-15) << "from the rows beside it";
  const ErrorBars none = error_bars(base, {});
  EXPECT_TRUE(none.largest.empty());
  EXPECT_EQ(none.shares.rows(), 0u);
}

TEST(ErrorBars, DoNotShrinkWhereTheVariantsThatDifferMostAreLost) {
  const ResultTable base = poses(0), far = poses(2, 0, -1, 2), near = poses(0.1);
  const ErrorBars out = error_bars(base, {{ErrorCause::fit, &far}, {ErrorCause::fit, &near}});
  for (std::size_t row = 0; row < 5; ++row) {
    EXPECT_NEAR(out.bars.number(row, "knee.x_mm"), 2, 1e-15) << row;
    EXPECT_EQ(out.bars.number(row, "variants"), row < 2 ? 2 : 1) << row;
  }
}

/// A contact that is open in a variant, or in the results, has no cells.
TEST(ErrorBars, KeepTheLastDistanceWhereACellIsEmpty) {
  const ResultTable base = poses(0), near = poses(0.1), far = poses(2, 0, -1, 5, 2);
  const ErrorBars out = error_bars(base, {{ErrorCause::fit, &far}, {ErrorCause::fit, &near}});
  for (std::size_t row = 0; row < 5; ++row) EXPECT_NEAR(out.bars.number(row, "knee.x_mm"), 2, 1e-15) << row;
}

}  // namespace
}  // namespace genu
