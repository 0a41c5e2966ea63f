// Loads and weights on chains of revolute joints, against closed forms.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/core/units.h"
#include "genu/scene/reader.h"
#include "motion_scene.h"
#include "support/scenes.h"

namespace genu {
namespace {

using test::kG;
using test::table_of;
using test::word;

/// Two links that hang from the ground on hinges about x: 3 kg 160 mm below the first hinge, the second hinge 300 mm
/// below it, 2 kg 200 mm below that.
constexpr double kUpper = (3 * 0.16 + 2 * 0.3) * kG, kLower = 2 * 0.2 * kG;  // N m: both weights at the first hinge,
                                                                             // the lower one at the second
std::string double_pendulum(const std::string& upper_hinge, const std::string& more) {
  return R"(format = 1
units = { length = "mm", angle = "rad" }
gravity = [0, 0, -9.81]
[body.ground]
fixed = true
[body.upper]
mass = 3
centre_of_mass = [0, 0, -160]
[body.lower]
mass = 2
centre_of_mass = [0, 0, -200]
[joint.h1]
type = "revolute"
parent = "ground"
child = "upper"
origin = [10, 20, 30]
axis = [1, 0, 0]
)" + upper_hinge +
         R"([joint.h2]
type = "revolute"
parent = "upper"
child = "lower"
origin = [0, 0, -300]
axis = [1, 0, 0]
)" + more;
}

TEST(LoadsOnJoints, ADoublePendulumHeldByAMomentOnItsLowerAngle) {
  const ResultTable t = table_of(double_pendulum("", R"([load.hold]
on = "h2.angle"
value = 3
[[step]]
load = { hold = [0, 1.2] }
increments = 6
)"));
  ASSERT_EQ(t.rows(), 7u);
  double worst = 0;
  for (std::size_t row = 0; row < t.rows(); ++row) {
    // The moment bends the lower link up and, as its reaction on the upper one, that one back.
    const double moment = 3 * 1.2 * static_cast<double>(row) / 6;
    const double direction = std::asin(moment / kLower), first = std::asin(-moment / kUpper);
    worst = std::max(worst, std::abs(t.number(row, "h1.angle_deg") * units::kDegree - first));
    worst = std::max(worst, std::abs(t.number(row, "h2.angle_deg") * units::kDegree - (direction - first)));
    EXPECT_EQ(word(t, row, "stability"), "stable");
    EXPECT_NEAR(t.number(row, "h1.reaction.force_z_N"), 5 * kG, 1e-9);
    EXPECT_NEAR(t.number(row, "h1.reaction.force_y_N"), 0, 1e-9);
    // The second hinge carries the lower weight, told in the axes of the upper link, and none of the moment.
    EXPECT_NEAR(t.number(row, "h2.reaction.force_y_N"), 2 * kG * std::sin(first), 1e-9);
    EXPECT_NEAR(t.number(row, "h2.reaction.force_z_N"), 2 * kG * std::cos(first), 1e-9);
    EXPECT_NEAR(t.number(row, "h2.reaction.moment_x_Nm"), 0, 1e-9);
  }
  EXPECT_LT(worst, 1e-10) << "worst angle, rad";
  EXPECT_GT(t.number(6, "h2.angle_deg"), 60) << "a large motion, or the test says little";
}

TEST(LoadsOnJoints, AMomentScaledOverAHingesAngleIsTheHingesOwnSpring) {
  const std::string rest = R"([load.push]
body = "lower"
force = [0, 12, 5]
point = [3, 4, -150]
[[step]]
load = { push = [0, 1] }
increments = 3
)";
  const ResultTable spring = table_of(double_pendulum("stiffness = 4\n", rest));
  const ResultTable load = table_of(double_pendulum("", R"([load.spring]
on = "h1.angle"
value = -4
scale = { over = "h1.angle", table = [[-2, -2], [2, 2]] }
)" + rest));
  ASSERT_EQ(spring.rows(), 4u);
  for (const char* column : {"h1.angle_deg", "h2.angle_deg", "h2.reaction.force_y_N", "h1.reaction.moment_y_Nm"})
    EXPECT_LT(test::worst_difference(spring, load, column), 1e-8) << column;
  EXPECT_LT(test::worst_difference(spring, load, "stability.min_eigenvalue_Nmm"), 1e-6);
  EXPECT_NEAR(load.number(3, "spring.scale"), load.number(3, "h1.angle_deg") * units::kDegree, 1e-12);
  EXPECT_GT(load.number(3, "h1.angle_deg"), 15);
}

}  // namespace
}  // namespace genu
