#include "genu/model/joint_spring.h"

#include <gtest/gtest.h>

#include "support/finite_difference.h"

namespace genu {
namespace {

TEST(JointSpring, PushesBackBeyondItsLimitsAlone) {
  JointSpring spring;
  spring.stiffness = 2;
  EXPECT_EQ(spring.moment(3), -6) << "without limits";
  spring.lower = -0.5;
  spring.upper = 1;
  spring.stop = 10;
  EXPECT_EQ(spring.moment(0.75), -1.5);
  EXPECT_EQ(spring.moment(1.5), -3 - 5);
  EXPECT_EQ(spring.moment(-1), 2 + 5);
}

TEST(JointSpring, ItsMomentChangesWithEachNumber) {
  JointSpring spring{.joint = 0, .stiffness = 2, .lower = -0.5, .upper = 1, .stop = 10};
  const std::pair<double JointSpring::*, double> numbers[] = {
      {&JointSpring::stiffness, 1}, {&JointSpring::lower, 1}, {&JointSpring::upper, 1}, {&JointSpring::stop, 1}};
  for (const double angle : {-2.0, -0.6, 0.3, 0.9, 1.4})
    for (const auto& [number, one] : numbers) {
      JointSpring change{.joint = 0, .stiffness = 0, .lower = 0, .upper = 0, .stop = 0};
      change.*number = one;
      const auto moment = [&, number = number](double d) {
        JointSpring edited = spring;
        edited.*number += d;
        return edited.moment(angle);
      };
      EXPECT_NEAR(spring.moment_rate(angle, change), test::derivative(moment, 1e-3), 1e-9) << angle;
    }
}

/// Not inlined: GCC 12 takes limits that are not there for uninitialized ones.
[[gnu::noinline]] JointSpring spring_of(const JointDef& joint) { return make_spring(joint, 2); }

TEST(JointSpring, IsMadeOfAJointWithOrWithoutLimits) {
  JointDef joint;
  joint.stiffness = 3;
  EXPECT_EQ(spring_of(joint).joint, 2);
  EXPECT_EQ(spring_of(joint).moment(5), -15);
  joint.limits = JointDef::Limits{-1, 1, 10};
  EXPECT_EQ(spring_of(joint).moment(2), -6 - 10);
}

TEST(JointSpring, ItsEnergyHasItsMomentAsSlope) {
  JointSpring spring;
  spring.stiffness = 2;
  spring.lower = -0.5;
  spring.upper = 1;
  spring.stop = 10;
  for (const double angle : {-2.0, -0.6, 0.3, 0.9, 1.4}) {
    const auto energy = [&](double d) { return spring.energy(angle + d); };
    const auto moment = [&](double d) { return spring.moment(angle + d); };
    EXPECT_NEAR(spring.moment(angle), -test::derivative(energy, 1e-3), 1e-9) << angle;
    EXPECT_NEAR(spring.slope(angle), test::derivative(moment, 1e-3), 1e-9) << angle;
  }
}

}  // namespace
}  // namespace genu
