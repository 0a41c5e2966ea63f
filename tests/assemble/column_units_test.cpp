// Units in the names of columns.
#include "genu/assemble/column_units.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

std::string unit_of(const std::string& name, bool angle) {
  const ColumnUnit* unit = column_label(name, angle).unit;
  return unit == nullptr ? "" : unit->name;
}

TEST(ColumnUnits, InBracketsOrAfterALine) {
  for (const char* name :
       {"a (deg)", "a[deg]", "a_deg", "a (Degrees)", "a [\xC2\xB0]", "a [\xB0]", "a_degrees", "x/a_deg/value"}) {
    EXPECT_EQ(unit_of(name, true), "deg") << name;
    EXPECT_EQ(column_label(name, true).word, "a") << name;
  }
  for (const char* name : {"a (rad)", "a_rad", "a [radians]"}) EXPECT_EQ(unit_of(name, true), "rad") << name;
  for (const char* name : {"a (mm)", "a[mm]", "a_mm"}) EXPECT_EQ(unit_of(name, false), "mm") << name;
  for (const char* name : {"a (m)", "a[m]", "a_m", "a (metres)"}) EXPECT_EQ(unit_of(name, false), "m") << name;
  EXPECT_EQ(unit_of("a (cm)", false), "cm");
  EXPECT_DOUBLE_EQ(column_unit("cm")->si, 0.01);
}

TEST(ColumnUnits, WhatIsNone) {
  EXPECT_EQ(unit_of("a_m", true), "") << "an ending counts for its own kind";
  EXPECT_EQ(column_label("a_m", true).word, "a_m");
  EXPECT_EQ(unit_of("a (mm)", true), "mm") << "brackets are a unit of whatever kind";
  EXPECT_EQ(column_label("a (inch)", false).unknown, "inch");
  EXPECT_EQ(column_label("a (inch)", false).path, "a (inch)");
  for (const char* name : {"deg", "_deg", "(deg)", "", "a)", "/x/a_deg/speed"})
    EXPECT_EQ(unit_of(name, true), "") << name;
}

}  // namespace
}  // namespace genu
