// Forces on free coordinates: slopes of the energy, and their derivatives by finite differences.
#include "genu/model/generalised_forces.h"
#include "genu/model/build_model.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/model/potential_energy.h"
#include "support/scene_model.h"

namespace genu {
namespace {

/// Two bodies in a row, a hinge between them; a load that follows its body where `follows`.
test::SceneModel chain(bool follows) {
  return test::scene_model(test::bone_on_ground() +
                           "[body.foot]\n[joint.ankle]\ntype = \"revolute\"\nparent = \"bone\"\nchild = "
                           "\"foot\"\norigin = [5, 7, -30]\naxis = "
                           "[1, 0.2, 0.3]\nstiffness = 2\n" +
                           test::ligament("rope", "[8, 10, 2]", "[20, 30, -40]",
                                          "law = \"quadratic\"\nstiffness = 5000\nslack_length = 20") +
                           "[ligament.tendon]\nfrom = { body = \"foot\", point = [4, -9, 3] }\nto = { body = "
                           "\"ground\", point = [0, 5, 60] }\n"
                           "law = \"spring\"\nstiffness = 3\nslack_length = 11\n" +
                           test::load("pull", std::string("force = [3, -4, 8]\npoint = [30, 5, 1]") +
                                                  (follows ? "\nframe = \"body\"" : "")));
}

const std::vector<double> kValues = {0.3, -0.4, 0.7, 0.01, 0.02, -0.015, 0.2};

GeneralisedForces at(const test::SceneModel& s, const std::vector<double>& q, double factor = 1) {
  Linearization memory;
  const auto found = generalised_forces(s.model, q, {factor}, 0, memory);
  EXPECT_TRUE(found);
  return found.value_or(GeneralisedForces());
}

TEST(GeneralisedForces, AreThoseOfFreeCoordinatesAlone) {
  const auto s = chain(false);
  const auto free = free_coordinates(s.model);
  ASSERT_EQ(free.size(), 7U);
  EXPECT_EQ(free.back(), (CoordinateRef{1, 0}));
  EXPECT_EQ(at(s, kValues).forces.size(), 7);
}

TEST(GeneralisedForces, AreSlopesOfTheEnergy) {
  const auto s = chain(false);
  const GeneralisedForces found = at(s, kValues);
  const auto energy = [&](std::vector<double> q, std::size_t i, double step) {
    q[i] += step;
    State state = reference_state(s.model);
    const auto free = free_coordinates(s.model);
    for (std::size_t k = 0; k < q.size(); ++k)
      state.coordinates[static_cast<std::size_t>(free[k].joint)][static_cast<std::size_t>(free[k].index)] = q[k];
    state.poses = poses_from_coordinates(s.model, state.coordinates);
    return *potential_energy(s.model, state, test::target_of(s.scene));
  };
  constexpr double kStep = 1e-5;
  for (std::size_t i = 0; i < kValues.size(); ++i) {
    const double slope = (energy(kValues, i, kStep) - energy(kValues, i, -kStep)) / (2 * kStep);
    EXPECT_NEAR(found.forces[static_cast<Eigen::Index>(i)], -slope, 1e-6 * found.forces.norm()) << i;
  }
}

void compare_with_differences(const test::SceneModel& s) {
  const GeneralisedForces found = at(s, kValues);
  constexpr double kStep = 1e-6;
  for (Eigen::Index j = 0; j < 7; ++j) {
    std::vector<double> up = kValues, down = kValues;
    up[static_cast<std::size_t>(j)] += kStep;
    down[static_cast<std::size_t>(j)] -= kStep;
    const VecX column = (at(s, up).forces - at(s, down).forces) / (2 * kStep);
    EXPECT_LE((column - found.derivatives.col(j)).norm(), 1e-7 * found.derivatives.norm()) << "coordinate " << j;
  }
}

TEST(GeneralisedForces, HaveDerivativesByFiniteDifferences) { compare_with_differences(chain(false)); }
TEST(GeneralisedForces, HaveThemForLoadsWithoutAPotential) { compare_with_differences(chain(true)); }

TEST(GeneralisedForces, HaveSymmetricDerivativesWhereAllHasAPotential) {
  const MatX with = at(chain(false), kValues).derivatives, follower = at(chain(true), kValues).derivatives;
  EXPECT_LE((with - with.transpose()).norm(), 1e-12 * with.norm());
  EXPECT_GT((follower - follower.transpose()).norm(), 1e-6 * follower.norm());
}

TEST(GeneralisedForces, AreAffineInTheLoadsFactor) {
  const auto s = chain(true);
  const VecX none = at(s, kValues, 0).forces, once = at(s, kValues, 1).forces, twice = at(s, kValues, 2).forces;
  EXPECT_GT((once - none).norm(), 1);
  EXPECT_LE((twice - 2 * once + none).norm(), 1e-12 * twice.norm());
}

TEST(GeneralisedForces, AreNoneAtAGimbalPose) {
  const auto s = chain(false);
  Linearization memory;
  std::vector<double> q = kValues;
  q[1] = M_PI / 2;
  EXPECT_FALSE(generalised_forces(s.model, q, {1}, 0, memory));
}

}  // namespace
}  // namespace genu
