#include "genu/equilibrium/state_difference.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "support/solved.h"

namespace genu {
namespace {

using Kind = PathEvent::Kind;

TEST(StateDifference, DistancesAddUpOverTheBodiesInCharacteristicLengths) {
  JointModel model;
  model.scales.length = 0.02;
  State a, b;
  a.poses = {Pose{}, Pose{exp_rotation(Vec3(0.3, -0.2, 1)), Vec3(1, 2, 3)}, Pose{}};
  b = a;
  b.poses[1].p += Vec3(0, 0.003, -0.004);
  b.poses[1].R = exp_rotation(Vec3(0, 0.25, 0)) * a.poses[1].R;
  b.poses[2].p += Vec3(0.001, 0, 0);
  EXPECT_NEAR(distance(model, a, b), 0.005 / 0.02 + 0.25 + 0.001 / 0.02, 1e-14);
  EXPECT_NEAR(distance(model, b, a), distance(model, a, b), 1e-14);
  const auto [metres, radians] = largest_motion(a, b);
  EXPECT_NEAR(metres, 0.005, 1e-16);
  EXPECT_NEAR(radians, 0.25, 1e-14);
}

// A chain of many bodies that turns as a whole about its first joint: only that one moves in its parent.
TEST(StateDifference, OfManyBodiesTheLargestMotionInAParentCounts) {
  std::string text = "format = 1\nunits = { length = \"mm\", angle = \"deg\" }\n[body.b0]\nfixed = true\n";
  for (int i = 1; i <= 12; ++i) {
    const std::string k = std::to_string(i);
    text += "[body.b" + k + "]\n[joint.j" + k + "]\ntype = \"free\"\nparent = \"b" + std::to_string(i - 1) +
            "\"\nchild = \"b" + k +
            "\"\nrotations = [\"a z\", \"b x\", \"c y\"]\ntranslations = [\"x\", \"y\", \"z\"]\n"
            "reference = { x = 50 }\n";
  }
  JointModel model = test::scene_model(text).model;
  model.scales.length = 0.02;
  const State straight = reference_state(model);
  State turned = straight;
  VecX twist(72);
  for (int k = 1; k < 13; ++k) {
    const Vec3& p = straight.poses[at(k)].p;
    turned.poses[at(k)] = Pose{exp_rotation(Vec3(0, 0, 0.1)), Vec3::Zero()} * straight.poses[at(k)];
    twist.segment<6>(6 * (k - 1)) << Vec3(0, 0, 0.1).cross(p), 0, 0, 0.1;
  }
  EXPECT_NEAR(distance(model, straight, turned), 0.1 + 2 * std::sin(0.05) * 0.05 / 0.02, 1e-13);
  EXPECT_NEAR(speed(model, straight, twist), 0.1 + 0.1 * 0.05 / 0.02, 1e-13);
}

TEST(StateDifference, SaysWhichContactsCameAndWent) {
  JointModel model;
  model.pairs.resize(2);
  model.pairs[0].name = "medial";
  model.pairs[1].name = "lateral";
  State before, after;
  before.contacts = {{0, 1, {}, 5}, {1, 3, {}, 2}};
  after.contacts = {{1, 3, {}, 7}, {0, 2, {}, 1}};
  const auto events = changes(model, before, after);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0], std::make_pair(Kind::contact_gained, std::string("medial.2")));
  EXPECT_EQ(events[1], std::make_pair(Kind::contact_lost, std::string("medial.1")));
  EXPECT_TRUE(changes(model, after, after).empty());
}

}  // namespace
}  // namespace genu
