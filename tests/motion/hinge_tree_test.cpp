// Bodies on hinges in the angles of these, against the coordinates of joints and difference quotients.
#include "genu/motion/hinge_tree.h"

#include "genu/motion/motion_rates.h"
#include "support/hinged_scene.h"

namespace genu {
namespace {

VecX angles() { return (VecX(3) << 0.3, -0.5, 0.8).finished(); }
VecX rates() { return (VecX(3) << 1.5, -2, 3).finished(); }

TEST(HingeTree, PlacesBodiesAsTheirJointsDo) {
  const JointModel model = test::hinged_model();
  ASSERT_TRUE(HingeTree::describes(model));
  HingeTree tree(model);
  ASSERT_EQ(tree.count(), 3);
  State state = reference_state(model);
  VecX twist;
  tree.place(angles(), rates(), state, twist);
  const std::vector<Pose> poses = poses_from_coordinates(model, state.coordinates);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_LT((poses[i].R - state.poses[i].R).norm(), 1e-15) << model.bodies[i].name;
    EXPECT_LT((poses[i].p - state.poses[i].p).norm(), 1e-16) << model.bodies[i].name;
  }
  const std::vector<JointValues> found = coordinate_rates(model, state, twist);
  for (std::size_t j = 0; j < found.size(); ++j) {
    const int hinge = tree.hinge({static_cast<int>(j), 0});
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(found[j][i], i == 0 && hinge >= 0 ? rates()[hinge] : 0, 1e-14) << model.joints[j].name << " " << i;
  }
}

TEST(HingeTree, IsNotOfJointsWithMoreFreedom) {
  const JointModel model = test::hinged_model(test::bone_on_ground() + test::step("increments = 1"));
  EXPECT_FALSE(HingeTree::describes(model));
}

/// Work is what a force does along the way: half of the rate of kinetic energy, M q'' . q', is that of the forces.
TEST(HingeTree, ForcesDoTheWorkThatTheBodiesGain) {
  const JointModel model = test::hinged_model();
  HingeTree tree(model);
  State state = reference_state(model);
  VecX twist, wrench = VecX::LinSpaced(6 * model.moving_count, -1, 2), moments(3), accelerations;
  moments << 0.3, 0.1, -0.2;
  const auto energy = [&](const VecX& q, const VecX& v) {
    tree.place(q, v, state, twist);
    return mechanical_energy(model, state, twist).kinetic;
  };
  tree.place(angles(), rates(), state, twist);
  ASSERT_TRUE(tree.accelerate(state, wrench, moments, accelerations));
  const double power = wrench.dot(twist) + moments.dot(rates());
  constexpr double kStep = 1e-5;
  const VecX q1 = angles() + kStep * rates(), q0 = angles() - kStep * rates();
  const VecX v1 = rates() + kStep * accelerations, v0 = rates() - kStep * accelerations;
  EXPECT_NEAR((energy(q1, v1) - energy(q0, v0)) / (2 * kStep), power, 1e-8 * std::abs(power));
}

TEST(HingeTree, WithoutMassThereIsNoAcceleration) {
  JointModel model = test::hinged_model();
  for (Inertia& inertia : model.inertias) inertia = {};
  HingeTree tree(model);
  State state = reference_state(model);
  VecX twist, accelerations;
  tree.place(angles(), rates(), state, twist);
  EXPECT_FALSE(tree.accelerate(state, VecX::Ones(6 * model.moving_count), VecX::Zero(3), accelerations));
}

}  // namespace
}  // namespace genu
