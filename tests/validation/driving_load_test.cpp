// Loads that hold a prescribed coordinate in the place of a reaction: closed forms, the same tension given as a load,
// derivatives, and what is said where a cable would have to push.
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "genu/core/units.h"
#include "support/crank_scene.h"
#include "support/knee_scene.h"
#include "support/scene_model.h"
#include "support/scenes.h"
#include "validation/sensitivity_case.h"

namespace genu::test {
namespace {

constexpr double kCrank = 40, kMast = 60, kForce = 20;  // mm, mm, N

/// The crank with a force on its end, in the world, and a cable from its end to the top of a mast over the hinge.
std::string crane(const std::string& steps) {
  return crank_scene(R"([load.down]
body = "crank"
point = [40, 0, 0]
force = [0, -20, 0]
[load.cable]
from = { body = "frame", point = [0, 60, 0] }
to = { body = "crank", point = [40, 0, 0] }
magnitude = 5
)" + steps);
}

/// mm: of the cable about the hinge, positive where it lifts the crank.
double arm_of_cable(double angle) {
  const Vec3 end = kCrank * Vec3(std::cos(angle), std::sin(angle), 0);
  return end.cross((Vec3(0, kMast, 0) - end).normalized()).z();
}

TEST(DrivingLoad, ACableHoldsACrane) {
  const ResultTable t =
      table_of(crane("[[step]]\nprescribe = { \"hinge.angle\" = [-40, 40] }\ndrive = \"cable\"\nincrements = 20\n"));
  ASSERT_EQ(t.rows(), 21u);
  EXPECT_FALSE(t.has_column("hinge.angle.reaction_Nm")) << "nothing but the cable holds the crane";
  for (std::size_t row = 0; row < t.rows(); ++row) {
    const double angle = t.number(row, "hinge.angle_deg") * units::kDegree;
    const double tension = kForce * kCrank * std::cos(angle) / arm_of_cable(angle);
    EXPECT_NEAR(t.number(row, "cable.factor"), tension / 5, 1e-11) << angle;
    // With the tension kept: potential of the weight and of the cable, V = F y + T L.
    const double h = 1e-4;
    const auto potential = [&](double q) {
      const Vec3 end = kCrank * Vec3(std::cos(q), std::sin(q), 0);
      return kForce * end.y() + tension * (Vec3(0, kMast, 0) - end).norm();
    };
    const double stiffness = (potential(angle + h) - 2 * potential(angle) + potential(angle - h)) / (h * h);
    EXPECT_EQ(word(t, row, "stability"), stiffness > 0 ? "stable" : "unstable") << angle;
  }
}

TEST(DrivingLoad, AReactionTakesOverAndGivesBack) {
  const ResultTable t = table_of(crane(
      "[[step]]\nprescribe = { \"hinge.angle\" = [-40, 0] }\nload = { cable = [0, 1] }\nincrements = 4\n"
      "[[step]]\nprescribe = { \"hinge.angle\" = [0, 10] }\ndrive = { \"hinge.angle\" = [\"cable\"] }\nincrements = 4\n"
      "[[step]]\nprescribe = { \"hinge.angle\" = [10, 20] }\nload = { cable = 2 }\nincrements = 4\n"));
  ASSERT_EQ(t.rows(), 13u);
  for (std::size_t row = 0; row < t.rows(); ++row) {
    const double angle = t.number(row, "hinge.angle_deg") * units::kDegree;
    const double turns = units::kMillimetre * kForce * kCrank * std::cos(angle),
                 lifts = units::kMillimetre * 5 * t.number(row, "cable.factor") * arm_of_cable(angle);
    if (t.number(row, "step") == 2) {
      EXPECT_NEAR(lifts, turns, 1e-12);
      EXPECT_TRUE(std::isnan(t.number(row, "hinge.angle.reaction_Nm")));
    } else {
      EXPECT_NEAR(lifts + t.number(row, "hinge.angle.reaction_Nm"), turns, 1e-12);
    }
  }
  EXPECT_EQ(t.number(12, "cable.factor"), 2);
}

TEST(DrivingLoad, WhatItFindsLeavesNoReactionWhereItIsGiven) {
  const std::string muscle = load("muscle",
                                  "point = [1, 2, 30]\ntoward = { body = \"ground\", point = [5, 40, -60] }\n"
                                  "magnitude = 15");
  const auto step = [](const std::string& rest) {
    return "[[step]]\nprescribe = { \"knee.flexion\" = [11, 51] }\n" + rest + "increments = 4\n";
  };
  const ResultTable driven = table_of(knee(muscle + step("drive = \"muscle\"\n")));
  ASSERT_EQ(driven.rows(), 5u);
  for (std::size_t row = 0; row < driven.rows(); ++row) {
    const double factor = driven.number(row, "muscle.factor");
    const ResultTable given = table_of(knee(
        muscle + fmt::format("[[step]]\nprescribe = {{ \"knee.flexion\" = {:.17g} }}\nload = {{ muscle = [{:.17g}, "
                             "{:.17g}] }}\n",
                             driven.number(row, "knee.flexion_deg"), 0.9 * factor, factor)));
    ASSERT_EQ(given.rows(), 2u);
    EXPECT_NEAR(given.number(1, "knee.flexion.reaction_Nm"), 0, 1e-10) << row;
    for (const std::string column : {"knee.x_mm", "knee.y_mm", "knee.z_mm", "knee.rotation_deg"})
      EXPECT_NEAR(given.number(1, column), driven.number(row, column), 1e-8) << column << " " << row;
  }
}

TEST(DrivingLoad, DerivativesAreWhatSolvingTheEditedSceneGives) {
  const std::string loads =
      load("push", "force = [3, -10, -20]\npoint = [3, 4, 10]") +
      load("muscle",
           "point = [1, 2, 30]\ntoward = { body = \"ground\", point = [5, 40, -60] }\nmagnitude = 15\n"
           "scale = { over = \"knee.flexion\", table = [[0, 0.5], [40, 1], [90, 2]] }");
  const std::string step =
      "[[step]]\nprescribe = { \"knee.flexion\" = [11, 14] }\ndrive = \"muscle\"\nincrements = 3\n";
  compare("driven knee", knee(loads + step), {0, 3});
}

TEST(DrivingLoad, ACableThatWouldHaveToPushIsADoubt) {
  const Solution solution = solution_of(
      replaced(crane("[[step]]\nprescribe = { \"hinge.angle\" = [0, 20] }\ndrive = \"cable\"\nincrements = 2\n"),
               "force = [0, -20, 0]", "force = [0, 20, 0]"));
  ASSERT_EQ(solution.poses.rows(), 3u);
  EXPECT_LT(solution.poses.number(2, "cable.factor"), 0);
  EXPECT_EQ(solution.summary.verdict_class, RunSummary::Class::doubtful);
  EXPECT_THAT(solution.summary.verdict, testing::Contains(testing::HasSubstr("cable would have to push")));
}

/// At 90 deg the line of the cable passes through the hinge.
TEST(DrivingLoad, ACableWithoutAMomentArmHoldsNothing) {
  const Solution solution =
      solution_of(crane("[[step]]\nprescribe = { \"hinge.angle\" = [80, 100] }\ndrive = \"cable\"\nincrements = 2\n"));
  ASSERT_EQ(solution.poses.rows(), 3u);
  EXPECT_EQ(word(solution.poses, 1, "status"), "undetermined");
  EXPECT_EQ(solution.summary.verdict_class, RunSummary::Class::not_solved);
  EXPECT_THAT(solution.summary.verdict,
              testing::Contains(testing::HasSubstr("load cable, which has no moment arm about hinge.angle")));
}

}  // namespace
}  // namespace genu::test
