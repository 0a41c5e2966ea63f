// The simplified knee flexed far beyond its range turns over at 196.2 deg: that is said first.
#include "genu/appraise/jumps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "genu/results/curves.h"
#include "support/scenes.h"

namespace genu {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

Solution flexed_to(double degrees, int increments) {
  Diagnostics out;
  auto scene = read_scene(test::dortmans_file(), out);
  EXPECT_TRUE(scene) << test::messages(out);
  scene->steps[0].prescribe[0].to = degrees * M_PI / 180;
  scene->steps[0].increments = increments;
  return test::solved(*scene);
}

TEST(Jumps, ComeFirstInTheVerdict) {
  const Solution s = flexed_to(200, 100);
  EXPECT_EQ(s.summary.poses_solved, 101);
  EXPECT_EQ(s.summary.verdict_class, RunSummary::Class::doubtful);
  EXPECT_EQ(s.summary.exit_code, kExitDoubtful);
  EXPECT_THAT(s.summary.verdict[0], StartsWith("Solved, but the joint jumped 1."));
  EXPECT_THAT(s.summary.verdict[0],
              HasSubstr(" mm / 101.5 deg at knee.flexion = 196.2 deg; the poses after that belong "
                        "to another position (branch 2)."));
  for (std::size_t row = 0; row < s.poses.rows(); ++row)
    EXPECT_EQ(s.poses.number(row, "branch"), s.poses.number(row, "knee.flexion_deg") < 196.2 ? 1 : 2) << row;
}

TEST(Jumps, InterruptTheCurves) {
  const Solution s = flexed_to(200, 100);
  Diagnostics out;
  const PlacedScene scene = place(*read_scene(test::dortmans_file(), out));
  const Chart chart = curves(scene, plan_steps(scene), s.poses, s.events);
  ASSERT_EQ(chart.breaks.size(), 1u);
  EXPECT_EQ(s.poses.number(chart.breaks[0], "branch"), 2);
  EXPECT_EQ(s.poses.number(chart.breaks[0] - 1, "branch"), 1);
}

TEST(Jumps, AreNotSaidOfAPathWithoutOne) {
  const Solution s = flexed_to(70, 35);
  EXPECT_EQ(s.summary.verdict_class, RunSummary::Class::solved);
  EXPECT_EQ(s.summary.exit_code, kExitOk);
  EXPECT_THAT(s.summary.verdict[0], StartsWith("Every pose is solved"));
}

/// Before the first row there is nothing that a path could connect it with.
TEST(Jumps, OnTheWayToTheFirstRowDoNotCount) {
  PathEvent event;
  event.kind = PathEvent::Kind::snapped;
  EXPECT_FALSE(event.begins_branch());
  event.rows_before = 1;
  EXPECT_TRUE(event.begins_branch());
  event.kind = PathEvent::Kind::stepped_over;  // the pose beyond is near
  EXPECT_FALSE(event.begins_branch());
}

}  // namespace
}  // namespace genu
