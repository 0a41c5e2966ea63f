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
