// What a pose lacks to balance: a closed form, and the derivative of the potential energy to every coordinate.
#include "genu/model/unbalanced.h"
#include "genu/model/build_model.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "genu/model/potential_energy.h"
#include "genu/scene/centre_bodies.h"
#include "support/scene_model.h"

namespace genu {
namespace {

State state_at(const JointModel& model, const std::vector<JointValues>& coordinates) {
  State state;
  state.coordinates = coordinates;
  state.poses = poses_from_coordinates(model, coordinates);
  return state;
}

TEST(Unbalanced, AForceAtAPointInTheBodysOwnFrame) {
  const auto s =
      test::scene_model(test::bone_on_ground() + test::load("pull", "force = [0, 0, 8]\npoint = [30, 0, 0]"));
  Linearization memory;
  const JointValues turned = {M_PI / 2, 0, 0, 0.1, -0.2, 0.3};  // about x: world z is the body's y
  const Unbalanced u = unbalanced(s.model, state_at(s.model, {turned}), test::target_of(s.scene), memory);
  Vec6 expected;
  expected << 0, -8, 0, 0, 0, -0.03 * 8;
  EXPECT_LE((u.wrenches.at(0) - expected).norm(), 1e-15) << u.wrenches[0].transpose();
}

/// Two bodies in a row, a hinge between them, ligaments and dead loads: all of it has a potential.
std::string chain(const std::string& x) {
  return test::bone_on_ground() +
         "[body.foot]\n[joint.ankle]\ntype = \"revolute\"\nparent = \"bone\"\nchild = \"foot\"\n" + "origin = [" + x +
         "5, 7, -30]\naxis = [1, 0.2, 0.3]\nstiffness = 2\n" +
         test::ligament("rope", "[" + x + "8, 10, 2]", "[20, 30, -40]",
                        "law = \"quadratic\"\nstiffness = 5000\nslack_length = 20") +
         "[ligament.tendon]\nfrom = { body = \"foot\", point = [4, -9, 3] }\nto = { body = \"ground\", point = [0, 5, "
         "60] }\n" +
         "law = \"spring\"\nstiffness = 3\nslack_length = 11\n" +
         test::load("pull", "force = [3, -4, 8]\npoint = [" + x + "30, 5, 1]");
}

void compare_with_energy(const test::SceneModel& s) {
  const std::vector<JointValues> q = {{0.3, -0.4, 0.7, 0.01, 0.02, -0.015}, s.model.joints[1].reference};
  const Target target = test::target_of(s.scene);
  Linearization memory;
  const Unbalanced u = unbalanced(s.model, state_at(s.model, q), target, memory);
  ASSERT_TRUE(u.forces);
  constexpr double kStep = 1e-5;
  double worst = 0, largest = 0;
  for (std::size_t j = 0; j < 2; ++j)
    for (std::size_t i = 0; i < 6; ++i) {
      std::vector<JointValues> up = q, down = q;
      up[j][i] += kStep;
      down[j][i] -= kStep;
      const auto above = potential_energy(s.model, state_at(s.model, up), target),
                 below = potential_energy(s.model, state_at(s.model, down), target);
      ASSERT_TRUE(above && below);
      const double expected = (*above - *below) / (2 * kStep);
      worst = std::max(worst, std::abs((*u.forces)[j][i] - expected));
      largest = std::max(largest, std::abs(expected));
    }
  EXPECT_GT(largest, 10);
  EXPECT_LE(worst, 1e-6 * largest) << "of " << largest;
}

TEST(Unbalanced, ForcesOnCoordinatesAreSlopesOfTheEnergy) { compare_with_energy(test::scene_model(chain(""))); }

TEST(Unbalanced, DoesNotDependOnWhereTheModelPutsItsOrigins) {
  Diagnostics out;
  auto scene = parse_scene(chain("90") + "[[step]]\nincrements = 1\n", "scene.toml", out);
  ASSERT_TRUE(scene);
  const std::vector<JointValues> q = {{0.3, -0.4, 0.7, 0.01, 0.02, -0.015}, scene->joints[1].reference};
  std::vector<Unbalanced> found;
  for (const double x : {0.0, 0.4}) {
    std::vector<Vec3> origins(scene->bodies.size(), Vec3::Zero());
    origins[1] = Vec3(x, -x, 2 * x);
    const PlacedScene moved = place(*scene, origins);
    const auto model = build_model(moved, {}, out);
    ASSERT_TRUE(model);
    Linearization memory;
    found.push_back(unbalanced(*model, state_at(*model, q), test::target_of(moved), memory));
  }
  double size = 0;
  for (const Vec6& wrench : found[0].wrenches) size = std::max(size, wrench.norm());
  for (std::size_t b = 0; b < 2; ++b)
    EXPECT_LE((found[0].wrenches[b] - found[1].wrenches[b]).norm(), 1e-14 * size) << b;
  for (std::size_t j = 0; j < 2; ++j)
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR((*found[0].forces)[j][i], (*found[1].forces)[j][i], 1e-14 * size) << j << " " << i;
}

TEST(Unbalanced, NothingOnCoordinatesAtAGimbalPose) {
  const auto s = test::scene_model(test::bone_on_ground() + test::load("pull", "force = [0, 0, 8]"));
  Linearization memory;
  const Unbalanced u =
      unbalanced(s.model, state_at(s.model, {{0, M_PI / 2, 0, 0, 0, 0}}), test::target_of(s.scene), memory);
  EXPECT_FALSE(u.forces);
  EXPECT_NEAR(u.wrenches.at(0).head<3>().norm(), 8, 1e-14);
}

}  // namespace
}  // namespace genu
