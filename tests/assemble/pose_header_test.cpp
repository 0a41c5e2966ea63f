// What the lines above the names of a storage file say.
#include "genu/assemble/pose_header.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

struct HeaderRead {
  PoseHeader header;
  std::string said;
};

HeaderRead read_header(const std::string& text) {
  Diagnostics out;
  HeaderRead read;
  {
    LongErrors errors("p.mot", out);
    read.header = read_pose_header(lines_of(text), errors);
  }
  for (const Diagnostic& d : out.items()) read.said += to_string(d) + "\n";
  return read;
}

TEST(PoseHeader, OpenSim) {
  const HeaderRead r = read_header("Coordinates\nversion=1\nnRows=4\nnColumns = 3\ninDegrees=YES\n");
  EXPECT_EQ(r.said, "");
  EXPECT_EQ(r.header.rows->count, 4u);
  EXPECT_EQ(r.header.columns->count, 3u);
  EXPECT_EQ(r.header.angles.degrees, true);
  EXPECT_EQ(r.header.angles.why, "inDegrees=yes");
  EXPECT_FALSE(r.header.angles.assumed);
}

TEST(PoseHeader, ASentence) {
  EXPECT_EQ(read_header("Angles are in degrees.\n").header.angles.degrees, true);
  EXPECT_EQ(read_header("  ANGLES are in RADIANS\n").header.angles.degrees, false);
  EXPECT_EQ(read_header("Angles are in degrees, not radians.\n").header.angles.degrees, std::nullopt);
  EXPECT_EQ(read_header("Units are S.I. units (second, meters, Newtons, ...)\n").header.angles.degrees, std::nullopt);
}

TEST(PoseHeader, SimmMeansDegrees) {
  const HeaderRead r = read_header("name trial.mot\ndatacolumns 3\ndatarows 4\notherdata 1\nrange 0.0 0.3\n");
  EXPECT_EQ(r.header.rows->count, 4u);
  EXPECT_EQ(r.header.columns->count, 3u);
  EXPECT_EQ(r.header.angles.degrees, true);
  EXPECT_TRUE(r.header.angles.assumed);
  EXPECT_EQ(read_header("datarows 4\ninDegrees=no\n").header.angles.degrees, false);
  EXPECT_EQ(read_header("range of motion of the left knee\n").header.angles.degrees, std::nullopt);
}

TEST(PoseHeader, WordsThatSayTheOpposite) {
  const HeaderRead r = read_header("inDegrees=no\nAngles are in degrees.\n");
  EXPECT_EQ(r.header.angles.degrees, false);
  EXPECT_EQ(r.header.angles.against, "\"Angles are in degrees.\"");
  EXPECT_FALSE(read_header("inDegrees=yes\nAngles are in degrees.\n").header.angles.against);
}

TEST(PoseHeader, UnitsThatNobodySays) {
  EXPECT_STREQ(unsaid_unit({}, true).name, "rad");
  EXPECT_STREQ(unsaid_unit(read_header("inDegrees=yes\n").header.angles, true).name, "deg");
  EXPECT_STREQ(unsaid_unit(read_header("inDegrees=no\n").header.angles, true).name, "rad");
  EXPECT_STREQ(unsaid_unit(read_header("inDegrees=yes\n").header.angles, false).name, "m");
}

TEST(PoseHeader, BadEntries) {
  EXPECT_EQ(read_header("inDegrees=maybe\n").said, "p.mot:1:11: inDegrees = maybe: must be yes or no\n");
  EXPECT_EQ(read_header("datarows many\n").said, "p.mot:1:10: datarows = many: must be a whole number >= 0\n");
}

}  // namespace
}  // namespace genu
