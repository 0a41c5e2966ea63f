// Columns by the names that users have for them.
#include "genu/assemble/column_names.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

ColumnNames names(const std::vector<std::string>& texts) {
  PoseFile::Row row{1, {}};
  for (const std::string& text : texts) row.cells.push_back({text, 1});
  return ColumnNames(row);
}

using Places = std::vector<std::size_t>;

TEST(ColumnNames, APathMatchesItsLastPart) {
  for (const char* column : {"knee_flex_r", "knee_flex_r/value", "/jointset/knee_r/knee_flex_r/value",
                             "/jointset/knee_r/knee_flex_r", "knee_flex_r (deg)", "knee_flex_r_deg"})
    EXPECT_EQ(names({"time", column}).called("knee_flex_r", true), Places{1}) << column;
  for (const char* column : {"knee_flex_r/speed", "/jointset/knee_r/knee_flex_r/speed",
                             "/forceset/knee_flex_r/activation", "knee_flex_r_mm", "knee_flex_l"})
    EXPECT_EQ(names({"time", column}).called("knee_flex_r", true), Places{}) << column;
  EXPECT_EQ(names({"a/speed"}).called("", true), Places{});
  EXPECT_EQ(names({"/a/q/value", "/b/q/value"}).called("q", true), (Places{0, 1}));
  EXPECT_EQ(names({"/a/q/value", "/b/q/value"}).called("/a/q", true), Places{0});
  for (const char* text :
       {"knee_flex_r/value", "knee_r/knee_flex_r", "knee_r/knee_flex_r/value", "/jointset/knee_r/knee_flex_r"})
    EXPECT_EQ(names({"time", "/jointset/knee_r/knee_flex_r/value"}).called(text, true), Places{1}) << text;
  EXPECT_EQ(names({"/jointset/knee_r/knee_flex_r/value"}).called("flex_r", true), Places{}) << "parts are whole";
  EXPECT_EQ(names({"/a/q/value", "q"}).called("q", true), Places{1}) << "a whole name comes first";
}

TEST(ColumnNames, TimeInSeconds) {
  for (const char* column : {"time", "Time", "time_s", "time (s)", "Time [s]"})
    EXPECT_EQ(names({"a", column}).time(), 1u) << column;
  for (const char* column : {"time (ms)", "t", "timer"}) EXPECT_FALSE(names({"a", column}).time()) << column;
}

TEST(ColumnNames, NearOnes) {
  EXPECT_EQ(names({"time", "/j/k/knee_flex_r/value"}).near("knee_flx_r"), "; did you mean \"knee_flex_r\"?");
  EXPECT_EQ(names({"time"}).near("knee_flx_r"), "");
}

}  // namespace
}  // namespace genu
