// The experiment of Leskovar et al. 2019 (meshes/leskovar2019/DRIVEN.md): a knee held by ligaments, and hinges
// calibrated to it.
#include "studies/driven_study.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/places.h"
#include "support/temporary_folder.h"
#include "support/text.h"
#include "validation/motion_scene.h"
#include "validation/study_files.h"

namespace genu::studies {
namespace {

const std::string kDrivenFolder = genu::test::source_folder() + "/meshes/leskovar2019";

const DrivenStudy& driven_study() {
  static const DrivenStudy solved = [] {
    Diagnostics out;
    return solve_driven(kDrivenFolder, out).value_or(DrivenStudy{});
  }();
  return solved;
}

TEST(DrivenStudy, TheKneeHeldByLigamentsMovesForBothPeriods) {
  const DrivenCurve& c = driven_study().ligaments;
  ASSERT_TRUE(c.complete);
  EXPECT_EQ(c.time.back(), 17);
  EXPECT_NEAR(*std::max_element(c.angle.begin(), c.angle.end()), 16.0, 0.3);
  EXPECT_NEAR(*std::min_element(c.angle.begin(), c.angle.end()), -21.5, 0.3);
}

TEST(DrivenStudy, ItIsSteeperThanTheSineAndTheHingeIsNot) {
  ASSERT_TRUE(driven_study().ligaments.complete && driven_study().hinges.complete);
  EXPECT_NEAR(driven_study().ligaments.steepest, 1.57, 0.05);
  EXPECT_NEAR(driven_study().ligaments.harmonics[2] / driven_study().ligaments.harmonics[0], 0.024, 0.004);
  EXPECT_NEAR(driven_study().hinges.steepest, 1, 0.01);
  EXPECT_LT(driven_study().hinges.harmonics[2] / driven_study().hinges.harmonics[0], 0.001);
  EXPECT_NEAR(driven_study().rms, 2.23, 0.05);
}

/// A third stiffer or softer, the hinge is farther from the ligament-held knee: it is calibrated.
TEST(DrivenStudy, NoOtherStiffnessIsNearer) {
  const auto distance = [](double factor) {
    std::string text = test::read_file(kDrivenFolder + "/scene-driven-hinges.toml");
    text = test::with_first(text, "stiffness = 1.4751", fmt::format("stiffness = {}", 1.4751 * factor));
    const Solution s = test::motion_of(text);
    double sum = 0;
    for (std::size_t row = 0; row < s.poses.rows(); ++row)
      sum += std::pow(s.poses.number(row, "j1.angle_deg") - driven_study().ligaments.angle[row], 2);
    return std::sqrt(sum / static_cast<double>(s.poses.rows()));
  };
  const double own = distance(1);
  EXPECT_NEAR(own, driven_study().rms, 1e-6);
  for (const double factor : {0.9, 0.97, 1.03, 1.1}) EXPECT_GT(distance(factor), own) << factor;
}

/// The target in the folder is the ligament-held knee's angle.
TEST(DrivenStudy, TheTargetIsThatAngle) {
  std::ifstream in(kDrivenFolder + "/driven-target.csv");
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "time_s,j1.angle_deg");
  std::size_t row = 0;
  for (; std::getline(in, line); ++row) {
    ASSERT_LT(row, driven_study().ligaments.time.size());
    const double time = std::stod(line), angle = std::stod(line.substr(line.find(',') + 1));
    EXPECT_NEAR(time, driven_study().ligaments.time[row], 1e-9);
    EXPECT_NEAR(angle, driven_study().ligaments.angle[row], 1e-2) << time;
  }
  EXPECT_EQ(row, driven_study().ligaments.time.size());
}

TEST(DrivenStudy, ThePageInTheFolderIsThatOfThisBuild) {
  test::expect_same_files(kDrivenFolder, driven_files(driven_study()));
}

}  // namespace
}  // namespace genu::studies
