// Forces without derivatives, against the ones that come with them.
#include "genu/motion/wrenches.h"

#include "genu/model/linearization.h"
#include "genu/motion/motion_rates.h"
#include "support/hinged_scene.h"

namespace genu {
namespace {

/// Everything is taut or slack, turned and moving.
struct TreeInMotion {
  explicit TreeInMotion(double angle) : model(test::hinged_model()), state(reference_state(model)) {
    for (std::size_t j = 0; j < model.joints.size(); ++j)
      state.coordinates[j][0] = angle * (1 + static_cast<double>(j));
    state.poses = poses_from_coordinates(model, state.coordinates);
    twist = VecX::LinSpaced(6 * model.moving_count, -2, 3);
    target.load_factors.assign(model.loads.size(), 0.7);
    target.time = 0.4;
    modes = damper_modes(model, state, twist);
  }
  JointModel model;
  State state;
  VecX twist;
  Target target;
  std::vector<DamperMode> modes;
};

TEST(Wrenches, AreThoseOfTheLinearization) {
  for (const double angle : {-0.4, -0.1, 0.05, 0.2, 0.6}) {
    TreeInMotion m(angle);
    for (JointModel::Ligament& l : m.model.ligaments) l.damping = 0;
    Linearization twin;
    // Loads on coordinates and springs of joints are not asked for here.
    for (std::size_t i = 0; i < m.model.loads.size(); ++i)
      if (m.model.loads[i].kind == Load::Kind::coordinate) m.target.load_factors[i] = 0;
    m.model.joint_springs.clear();
    linearize_forces(m.model, m.state, m.target, twin);
    VecX wrench = VecX::Zero(twin.wrench.size());
    EXPECT_EQ(add_ligament_wrenches(m.model, m.state, m.modes, m.twist, wrench), 0);
    const double power = add_load_wrenches(m.model, m.state, m.target, m.twist, wrench);
    add_weight_wrenches(m.model, m.state, wrench);
    EXPECT_LT((wrench - twin.wrench).norm(), 1e-14 * twin.wrench.norm()) << angle;
    EXPECT_NEAR(power, load_power(m.model, m.state, m.target, m.twist), 1e-14);
  }
}

TEST(Wrenches, DampersAreThoseOfDamping) {
  int relaxed = 0, slack = 0;
  for (const double angle : {-0.4, -0.1, 0.05, 0.2, 0.6})
    for (const double speed : {-1.0, 1.0}) {
      TreeInMotion m(angle);
      m.twist *= speed;
      for (JointModel::Ligament& l : m.model.ligaments) l.damping = 30;
      m.modes = damper_modes(m.model, m.state, m.twist);
      for (const DamperMode mode : m.modes) relaxed += mode == DamperMode::relaxed, slack += mode == DamperMode::slack;
      VecX wrench = VecX::Zero(m.twist.size()), still = wrench, twin = wrench;
      const double taken = add_ligament_wrenches(m.model, m.state, m.modes, m.twist, wrench);
      auto undamped = m.model;
      for (JointModel::Ligament& l : undamped.ligaments) l.damping = 0;
      add_ligament_wrenches(undamped, m.state, m.modes, m.twist, still);
      m.model.joint_dampers.clear();
      const double power = add_damping(m.model, m.state, m.modes, m.twist, twin);
      EXPECT_LT((wrench - still - twin).norm(), 1e-13 * (1 + twin.norm())) << angle;
      EXPECT_NEAR(taken, power, 1e-13 * (1 + power));
    }
  EXPECT_GT(relaxed, 0);
  EXPECT_GT(slack, 0);
}

}  // namespace
}  // namespace genu
