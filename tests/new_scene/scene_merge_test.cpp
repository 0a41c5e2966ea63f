#include "genu/new_scene/scene_merge.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

const std::string kWritten = R"(# A knee of 80 mm.
format = 1
title = "knee"

[body.femur]
fixed = true

# anterior cruciate
[ligament.ACL1]
from = { body = "femur", point = [1, 2, 3] }   # +- 3 mm
stiffness = 800
slack_length = 30.5

[ligament.LCL1]
stiffness = 600

[[step]]                   # settle
increments = 9

[[step]]
increments = 120
)";

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

const std::string kFresh =
    changed(changed(changed(kWritten, "80 mm", "81 mm"), "[1, 2, 3] }   # +- 3 mm", "[1.5, 2, 3] }   # +- 2 mm"),
            "slack_length = 30.5", "slack_length = 31");

TEST(SceneMerge, WithoutChangesIsTheNewScene) {
  const MergedScene merged = merge_scenes(kWritten, kWritten, kFresh);
  EXPECT_EQ(merged.text, kFresh);
  EXPECT_EQ(merged.kept, 0);
  EXPECT_TRUE(merged.conflicts.empty());
  EXPECT_EQ(merge_scenes(kWritten, kWritten, kWritten).text, kWritten);
}

TEST(SceneMerge, OfTheSameNewSceneIsTheUsers) {
  const std::string mine = changed(changed(kWritten, "stiffness = 800", "stiffness = 900  # mine"),
                                   "[ligament.LCL1]\nstiffness = 600\n\n", "");
  const MergedScene merged = merge_scenes(kWritten, mine, kWritten);
  EXPECT_EQ(merged.text, mine);
  EXPECT_EQ(merged.kept, 2);
  EXPECT_TRUE(merged.conflicts.empty());
}

TEST(SceneMerge, KeepsWhatTheUserChanged) {
  std::string mine = changed(kWritten, "stiffness = 800", "stiffness = 900");
  mine = changed(mine, "increments = 120", "increments = 60");
  const MergedScene merged = merge_scenes(kWritten, mine, kFresh);
  EXPECT_EQ(merged.text,
            changed(changed(kFresh, "stiffness = 800", "stiffness = 900"), "increments = 120", "increments = 60"));
  EXPECT_EQ(merged.kept, 2);
  EXPECT_TRUE(merged.conflicts.empty());
}

TEST(SceneMerge, SaysWhereBothHaveChanged) {
  const std::string mine = changed(kWritten, "slack_length = 30.5", "slack_length = 29   # measured");
  const MergedScene merged = merge_scenes(kWritten, mine, kFresh);
  EXPECT_EQ(merged.text, changed(kFresh, "slack_length = 31", "slack_length = 29   # measured"));
  ASSERT_EQ(merged.conflicts.size(), 1u);
  EXPECT_EQ(merged.conflicts[0].key, "ligament.ACL1.slack_length");
  EXPECT_EQ(merged.conflicts[0].mine, "29");
  EXPECT_EQ(merged.conflicts[0].fresh, "31");
  EXPECT_EQ(merged.conflicts[0].where, (SourceLocation{12, 1}));
  // The same change is none.
  EXPECT_TRUE(merge_scenes(kWritten, changed(kWritten, "= 30.5", "= 31"), kFresh).conflicts.empty());
}

TEST(SceneMerge, KeepsWhatTheUserAddedWhereItStood) {
  std::string mine = changed(kWritten, "slack_length = 30.5\n", "slack_length = 30.5\ndamping = 2\n");
  mine =
      changed(mine, "[ligament.LCL1]",
              "[ligament.mine]\npoints = [[0, 1],  # ] one\n  [2, 3]]\nnote = \"# no comment ]\"\n\n[ligament.LCL1]");
  const MergedScene merged = merge_scenes(kWritten, mine, kFresh);
  std::string expected = changed(kFresh, "slack_length = 31\n", "slack_length = 31\ndamping = 2\n");
  expected =
      changed(expected, "[ligament.LCL1]",
              "[ligament.mine]\npoints = [[0, 1],  # ] one\n  [2, 3]]\nnote = \"# no comment ]\"\n\n[ligament.LCL1]");
  EXPECT_EQ(merged.text, expected);
  EXPECT_EQ(merged.kept, 2);  // a key and a table
}

TEST(SceneMerge, KeepsCommentsOfTheUser) {
  std::string mine = changed(kWritten, "# anterior cruciate\n", "# anterior cruciate\n# looked at in Slicer\n");
  mine = changed(mine, "# A knee of 80 mm.\n", "# A knee of 80 mm.\n# Patient 7\n");
  mine = changed(mine, "# +- 3 mm", "# checked");
  const MergedScene merged = merge_scenes(kWritten, mine, kFresh);
  EXPECT_EQ(merged.text,
            changed(changed(changed(kFresh, "# anterior cruciate\n", "# anterior cruciate\n# looked at in Slicer\n"),
                            "# A knee of 81 mm.\n", "# A knee of 81 mm.\n# Patient 7\n"),
                    "# +- 2 mm", "# checked"));
  EXPECT_TRUE(merged.conflicts.empty());
}

TEST(SceneMerge, LeavesOutWhatTheUserTookOut) {
  const std::string lcl = "[ligament.LCL1]\nstiffness = 600\n\n";
  const std::string fresh = changed(kFresh, lcl, "[ligament.LCL1]\nstiffness = 600\ntransition = 2\n\n");
  EXPECT_EQ(merge_scenes(kWritten, changed(kWritten, lcl, ""), fresh).text, changed(kFresh, lcl, ""));
}

/// The new scene has other ligaments: a table that the user worked on stays, whole.
TEST(SceneMerge, KeepsTablesThatWent) {
  const std::string mine = changed(kWritten, "stiffness = 800", "stiffness = 900"),
                    lcl = "[ligament.LCL1]\nstiffness = 600\n\n";
  const std::string acl =
      kFresh.substr(kFresh.find("# anterior"), kFresh.find("[ligament.LCL1]") - kFresh.find("# anterior"));
  const MergedScene merged = merge_scenes(kWritten, mine, changed(changed(kFresh, acl, ""), lcl, ""));
  EXPECT_NE(merged.text.find("point = [1, 2, 3] }   # +- 3 mm\nstiffness = 900\nslack_length = 30.5\n"),
            std::string::npos);
  EXPECT_EQ(merged.text.find("LCL1"), std::string::npos);  // untouched, and gone
  ASSERT_EQ(merged.conflicts.size(), 1u);
  EXPECT_EQ(merged.conflicts[0].key, "ligament.ACL1.stiffness");
  EXPECT_EQ(merged.conflicts[0].fresh, "");
}

TEST(SceneMerge, ReadsLineEndsOfWindows) {
  std::string mine;
  for (const char c : changed(kWritten, "stiffness = 800", "stiffness = 900"))
    mine += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const MergedScene merged = merge_scenes(kWritten, mine, kFresh);
  EXPECT_EQ(merged.kept, 1);
  EXPECT_NE(merged.text.find("stiffness = 900"), std::string::npos);
  EXPECT_NE(merged.text.find("slack_length = 31\n"), std::string::npos);
}

}  // namespace
}  // namespace genu
