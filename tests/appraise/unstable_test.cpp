// A joint does not stay where it is unstable: that is a doubt, unless the scene asks for such poses.
#include "genu/appraise/unstable.h"

#include <algorithm>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/crank_scene.h"
#include "support/scenes.h"

namespace genu {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

int unstable_rows(const ResultTable& poses) {
  int count = 0;
  for (std::size_t row = 0; row < poses.rows(); ++row)
    count += test::word(poses, row, "stability") == "unstable" ? 1 : 0;
  return count;
}

/// A rod of 40 mm, upright on a hinge with a spring of 0.2 N m/rad: it buckles under 5 N. (The flap is there because
/// something has to be free.)
std::string rod(const std::string& step) {
  return R"(format = 1
title = "rod"
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
[body.rod]
[joint.hinge]
type = "revolute"
parent = "ground"
child = "rod"
axis = [0, 1, 0]
stiffness = 0.0034906585
[body.flap]
[joint.flap]
type = "revolute"
parent = "ground"
child = "flap"
axis = [0, 1, 0]
stiffness = 1
[load.weight]
body = "rod"
point = [0, 0, 40]
force = [0, 0, -1]
)" + step;
}

TEST(Unstable, PosesAreDoubted) {
  const Solution s = test::solution_of(rod("[[step]]\nload = { weight = [0, 8] }\nincrements = 4\n"));
  ASSERT_EQ(s.poses.rows(), 5u);
  EXPECT_EQ(unstable_rows(s.poses), 2) << "at 6 and 8 N";
  EXPECT_EQ(s.summary.verdict_class, RunSummary::Class::doubtful);
  EXPECT_EQ(s.summary.exit_code, kExitDoubtful);
  EXPECT_EQ(s.summary.verdict[0],
            "Solved, but 2 of 5 poses are unstable, the first at load weight x 6: the joint would not stay there.");
}

TEST(Unstable, OneIsNotSeveral) {
  const Solution s = test::solution_of(rod("[[step]]\nload = { weight = [0, 6] }\nincrements = 3\n"));
  EXPECT_THAT(s.summary.verdict[0], StartsWith("Solved, but 1 of 4 poses is unstable, at load weight x 6: the joint "
                                               "would not stay there."));
}

TEST(Unstable, WhatIsHeldIsStable) {
  const Solution s = test::solution_of(
      rod("[[step]]\nprescribe = { \"hinge.angle\" = 0 }\nload = { weight = [0, 8] }\nincrements = 4\n"));
  EXPECT_EQ(unstable_rows(s.poses), 0);
  EXPECT_EQ(s.summary.exit_code, kExitOk);
}

/// Round a limit point a path is unstable: who follows it by arc length asks for that.
TEST(Unstable, ByArcLengthTheyAreAskedFor) {
  Diagnostics out;
  auto scene = read_scene(test::source_folder() + "/meshes/dortmans1984/scene-moment.toml", out);
  ASSERT_TRUE(scene) << test::messages(out);
  const Solution s = test::solved(*scene);
  EXPECT_GT(unstable_rows(s.poses), 0);
  EXPECT_THAT(s.summary.verdict[0], HasSubstr(", the others unstable: arc length follows the path there too (see"));
  EXPECT_EQ(s.summary.verdict_class, RunSummary::Class::solved);
}

/// A load of unknown factor is kept constant for the stability: a cable over the hinge cannot keep the crank upright.
TEST(Unstable, HeldByALoadTheyAreAskedFor) {
  const Solution s = test::solution_of(test::crank_scene(R"([load.down]
body = "crank"
point = [40, 0, 0]
force = [0, -20, 0]
[load.cable]
from = { body = "frame", point = [0, 60, 0] }
to = { body = "crank", point = [40, 0, 0] }
magnitude = 5
[[step]]
prescribe = { "hinge.angle" = [-40, 40] }
drive = "cable"
increments = 20
)"));
  EXPECT_GT(unstable_rows(s.poses), 0);
  EXPECT_EQ(s.summary.verdict_class, RunSummary::Class::solved);
  EXPECT_THAT(s.summary.verdict[0], HasSubstr("the load that holds the joint, kept constant, would not hold it there"));
}

}  // namespace
}  // namespace genu
