#include "genu/core/number_row.h"

#include <cmath>

#include <gtest/gtest.h>

namespace genu {
namespace {

using Range = NumberRow::Range;

TEST(NumberRow, ReportsWhatIsWrongWithAValue) {
  const NumberRow stiffness{.key = "stiffness"}, toe{.key = "toe", .range = Range::above_zero_or_limit},
      damping{.key = "damping", .range = Range::at_least_zero}, force{.key = "force", .range = Range::any};
  EXPECT_EQ(stiffness.fault(1), "");
  EXPECT_EQ(stiffness.fault(0), "stiffness must be > 0");
  EXPECT_EQ(stiffness.fault(std::nan("")), "stiffness must be > 0");
  EXPECT_EQ(toe.fault(0), "");
  EXPECT_EQ(toe.fault(-1), "toe must be >= 0");
  EXPECT_EQ(damping.fault(0), "");
  EXPECT_EQ(damping.fault(-1), "damping must be >= 0");
  EXPECT_EQ(force.fault(-3), "");
  EXPECT_EQ(force.fault(INFINITY), "force must be finite");
}

TEST(NumberRow, UnitsFollowTheScenesChoice) {
  const ChosenUnits metres{1, 1, "m", "rad"};
  EXPECT_EQ(unit_name(Unit::force_per_area), "N/mm^2");
  EXPECT_EQ(si(Unit::force_per_area), 1e6);
  EXPECT_EQ(unit_name(Unit::force_per_area, metres), "N/m^2");
  EXPECT_EQ(si(Unit::force_per_area, metres), 1);
  EXPECT_EQ(unit_name(Unit::moment_per_rate, metres), "N m s/rad");
  EXPECT_EQ(si(Unit::force_per_speed), 1e3);
  EXPECT_EQ(si(Unit::moment_per_angle), 1 / units::kDegree);
  EXPECT_EQ(unit_name(Unit::length, metres), "m");
  EXPECT_EQ(unit_name(Unit::mass), "kg");
  EXPECT_EQ(unit_name(Unit::number), "");
}

TEST(NumberRow, NamesUnitsAsColumnsDo) {
  EXPECT_EQ(unit_in_results(Unit::number), "1");
  EXPECT_EQ(unit_in_results(Unit::moment), "Nm");
  EXPECT_EQ(unit_in_results(Unit::moment_per_angle), "Nm/deg");
  EXPECT_EQ(unit_in_results(Unit::moment_per_rate), "Nm s/deg");
  EXPECT_EQ(unit_in_results(Unit::force_per_speed), "N s/mm");
}

TEST(NumberRow, HasAStandardChange) {
  EXPECT_EQ(standard_change(Unit::length), 1e-3);
  EXPECT_EQ(standard_change_text(Unit::length), "1 mm");
  EXPECT_EQ(standard_change(Unit::angle), units::kDegree);
  EXPECT_EQ(standard_change_text(Unit::moment), "0.01 Nm");
  EXPECT_EQ(standard_change(Unit::number), 0.01);
  EXPECT_EQ(standard_change_text(Unit::number), "0.01");
  EXPECT_EQ(standard_change_text(Unit::force), "1 N");
}

TEST(NumberRow, IsNamedByItsKeyUnlessItHasAName) {
  EXPECT_STREQ((NumberRow{.key = "radius"}.parameter()), "radius");
  EXPECT_STREQ((NumberRow{.key = "from", .name = "limits.from"}.parameter()), "limits.from");
}

}  // namespace
}  // namespace genu
