// Measured knees under ten times their passive load: poses that contacts hold in place, and folds beyond which a stable
// pose is found.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/judged.h"
#include "support/scenes.h"
#include "support/ssm_scene.h"

namespace genu {
namespace {

/// Judged as well.
Solution solve_heavy(const std::string& text) {
  const test::TemporaryFolder folder;
  Diagnostics out;
  Solution solution;
  EXPECT_NE(run_scene(folder.write("scene.toml", text), folder / "out", {}, out, &solution), kExitRefused);
  EXPECT_FALSE(out.has_errors()) << test::messages(out);
  test::expect_judged_ok(folder / "scene.toml", solution.poses);
  return solution;
}

std::string under_load(const std::string& subject, const std::string& newton, int degrees, int increments) {
  return test::replaced(test::ssm_scene(subject, degrees, increments), "force = [0, 100, 0]",
                        "force = [0, " + newton + ", 0]");
}

std::vector<PathEvent> events_of(const Solution& solution, PathEvent::Kind kind) {
  std::vector<PathEvent> out;
  std::copy_if(solution.events.begin(), solution.events.end(), std::back_inserter(out),
               [&](const PathEvent& e) { return e.kind == kind; });
  return out;
}

/// Near extension five places carry the load: with the flexion prescribed nothing is free to move there.
TEST(HeavyKnee, FivePlacesHoldItInPlace) {
  GENU_NEEDS_DATA("ssm/S001_Femur_Cartilage.ply");
  for (const char* newton : {"315", "500", "1000"}) {
    const Solution solution = solve_heavy(under_load("S001", newton, 90, 90));
    EXPECT_EQ(solution.summary.exit_code, kExitOk) << newton;
    EXPECT_GE(solution.summary.poses_stable, 89) << newton;  // the load follows the tibia, and can make it flutter
    for (const PoseRecord& record : solution.records)
      EXPECT_NE(record.point.stability.verdict, Stability::Verdict::unstable) << newton;
    std::size_t most = 0;
    for (const PoseRecord& record : solution.records) {
      most = std::max(most, record.point.pose.state.contacts.size());
      if (record.point.pose.state.contacts.size() == 5) {
        EXPECT_EQ(record.point.stability.free_motions, 0) << newton;
      }
    }
    std::printf("%s N: up to %zu contacts\n", newton, most);
    if (std::string(newton) == "1000") {
      EXPECT_EQ(most, 5u);
    }
  }
}

/// The rigid joint's equilibrium ends; it slides to the next stable pose, the same whatever the increments.
TEST(HeavyKnee, SnapsBetweenRigidSurfacesAndGoesOn) {
  GENU_NEEDS_DATA("ssm/S002_Femur_Cartilage.ply");
  std::vector<double> folds;
  for (const int increments : {45, 90}) {
    const Solution solution = solve_heavy(under_load("S002", "1000", 90, increments));
    EXPECT_EQ(solution.summary.exit_code, kExitDoubtful) << increments;
    EXPECT_EQ(solution.summary.poses_stable, increments + 1) << increments;
    const auto snapped = events_of(solution, PathEvent::Kind::snapped),
               landed = events_of(solution, PathEvent::Kind::new_branch);
    ASSERT_GE(snapped.size(), 1u) << increments;
    ASSERT_EQ(landed.size(), snapped.size()) << increments;
    folds.push_back(snapped[0].target.prescribed[0].value);
    EXPECT_EQ(landed[0].what, "stable") << increments;
    EXPECT_NE(landed[0].coordinates, snapped[0].coordinates) << increments;
  }
  EXPECT_NEAR(folds[0], folds[1], 1e-6);
}

}  // namespace
}  // namespace genu
