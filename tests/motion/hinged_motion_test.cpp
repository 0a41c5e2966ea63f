// The equations of motion in angles, against those with constraints and multipliers.
#include "genu/motion/hinged_motion.h"

#include "genu/model/linearization.h"
#include "genu/model/twist.h"
#include "genu/motion/equations_of_motion.h"
#include "genu/motion/motion_rates.h"
#include "support/hinged_scene.h"

namespace genu {
namespace {

TEST(HingedMotion, IsForTreesOfHingesAlone) {
  JointModel model = test::hinged_model();
  EXPECT_TRUE(HingedMotion::fits(model));
  model.pairs.push_back({});
  EXPECT_FALSE(HingedMotion::fits(model));
}

/// q'' = J a + v . H v of the accelerations a that constraints and multipliers give.
TEST(HingedMotion, AcceleratesAsTheConstrainedBodiesDo) {
  const JointModel model = test::hinged_model();
  EquationsOfMotion equations(model, 1e-9);
  ASSERT_EQ(equations.size(), 8);
  for (const double scale : {-0.6, -0.2, 0.1, 0.4, 1.0}) {
    SCOPED_TRACE(scale);
    VecX y(8), rate(8);
    y << 0.3 * scale, 0.5 * scale, -0.7 * scale, 2, -3 * scale, 4, 0, 0;
    MotionPoint point;
    ASSERT_TRUE(equations.see(0.3, y, point));
    equations.modes() = damper_modes(model, point.state, point.twist);
    ASSERT_TRUE(equations.rate(0.3, y, rate));
    ASSERT_TRUE(equations.read(0.3, y, point));
    EXPECT_LT(point.residual, 1e-14);
    EXPECT_LT((equations.pack(point) - y).norm(), 1e-13);
    const HingeTree tree(model);
    for (Eigen::Index i = 0; i < 3; ++i) {
      const JointPoint joint = joint_point(model, point.state, tree.joint(i));
      const Vec12 twist = twist_of_pair(model, tree.joint(i), point.twist);
      const double q = joint.gradient(0).dot(twist_of_pair(model, tree.joint(i), point.acceleration)) +
                       twist.dot(joint.hessian(0) * twist);
      EXPECT_NEAR(rate[i], y[3 + i], 1e-14);
      EXPECT_NEAR(rate[3 + i], q, 1e-9 * (1 + std::abs(q))) << i;
    }
  }
}

/// The work of loads and what dampers take are the power of those forces.
TEST(HingedMotion, SumsWorkAndLoss) {
  const JointModel model = test::hinged_model();
  EquationsOfMotion equations(model, 1e-9);
  VecX y(8), rate(8);
  y << 0.2, 0.3, -0.1, 2, -3, 4, 0, 0;
  MotionPoint point;
  ASSERT_TRUE(equations.see(0.3, y, point));
  equations.modes() = damper_modes(model, point.state, point.twist);
  ASSERT_TRUE(equations.rate(0.3, y, rate));
  EXPECT_NEAR(rate[6], load_power(model, point.state, equations.target_at(0.3), point.twist), 1e-13);
  VecX wrench = VecX::Zero(point.twist.size());
  EXPECT_NEAR(rate[7], add_damping(model, point.state, equations.modes(), point.twist, wrench), 1e-12 * rate[7]);
}

}  // namespace
}  // namespace genu
