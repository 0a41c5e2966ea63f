// Numbers as a new scene has them.
#include "genu/new_scene/new_numbers.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(NewNumbers, AreToATenthOfAMillimetre) {
  EXPECT_EQ(tenths(0.01234), "12.3");
  EXPECT_EQ(tenths(-1e-6), "0");
  EXPECT_EQ(point_text(Vec3(0.0012, 0.003, -0.0005)), "[1.2, 3, -0.5]");
}

TEST(NewNumbers, LengthsAreThoseOfSolvedRows) {
  ResultTable poses;
  poses.add_column("ACL.length_mm");
  poses.add_row();
  poses.add_row();
  poses.set("ACL.length_mm", 31.5);
  EXPECT_FALSE(length_in(poses, 0, "ACL"));
  EXPECT_DOUBLE_EQ(length_in(poses, 1, "ACL").value(), 0.0315);
  EXPECT_FALSE(length_in(poses, 1, "PCL"));
}

TEST(NewNumbers, ReadTheLengthThatStandsThere) {
  std::string text = "reference_strain = 0.03";
  EXPECT_TRUE(set_slack(text, 0.03125));
  EXPECT_EQ(text, "slack_length = 31.25");
  EXPECT_FALSE(set_slack(text, 0.03135));  // 0.1 mm: settled
  EXPECT_TRUE(set_slack(text, 0.0317));
}

TEST(NewNumbers, StiffnessesHaveFourDigits) {
  EXPECT_EQ(stiffness_word("ACLam1"), "stiffness of ACLam1");
  EXPECT_EQ(stiffness_text(1234.56), "stiffness = 1235");
}

}  // namespace
}  // namespace genu
