// Energy against the forces: its derivative along every twist is the wrench, with the sign turned round.
#include "genu/model/potential_energy.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "genu/model/linearization.h"
#include "support/scene_model.h"

namespace genu {
namespace {

using test::bone_on_ground;
using test::ligament;
using test::load;
using test::scene_model;

/// The largest difference of d energy / d twist and -wrench, relative to the largest wrench.
double worst_derivative(const test::SceneModel& s, State state, double time = 0) {
  Target target = test::target_of(s.scene);
  target.time = time;
  fit_multipliers(s.model, target, state);
  update_coordinates(s.model, state);
  Linearization here;
  linearize(s.model, state, target, here);
  const auto energy = [&](Eigen::Index i, double step) {
    State moved = state;
    for (std::size_t body = 0; body < s.model.bodies.size(); ++body) {
      if (s.model.bodies[body].moving < 0) continue;
      Vec6 twist = Vec6::Zero();
      const Eigen::Index k = i - 6 * s.model.bodies[body].moving;
      if (k >= 0 && k < 6) twist[k] = step;
      moved.poses[body] = retract(state.poses[body], twist);
    }
    update_coordinates(s.model, moved);
    return potential_energy(s.model, moved, target).value();
  };
  double worst = 0;
  for (Eigen::Index i = 0; i < here.wrench.size(); ++i) {
    const double h = i % 6 < 3 ? 1e-5 : 1e-3;
    const double slope = (8 * (energy(i, h) - energy(i, -h)) - (energy(i, 2 * h) - energy(i, -2 * h))) / (12 * h);
    worst = std::max(worst, std::abs(slope + here.wrench[i]));
  }
  return worst / here.wrench.cwiseAbs().maxCoeff();
}

State turned(const test::SceneModel& s) {
  State state = reference_state(s.model);
  for (std::size_t i = 0; i < s.model.bodies.size(); ++i)
    if (s.model.bodies[i].moving >= 0)
      state.poses[i] = {exp_rotation(Vec3(0.2, -0.3, 0.4)) * state.poses[i].R,
                        state.poses[i].p + Vec3(4, -3, 5) * 1e-3};
  return state;
}

TEST(PotentialEnergy, EveryLawsDerivativeIsItsForce) {
  const char* laws[] = {
      "law = \"quadratic\"\nstiffness = 5000\nslack_length = 30",
      "law = \"linear\"\nstiffness = 4000\nslack_length = 28",
      "law = \"blankevoort\"\nstiffness = 3000\ntransition_strain = 0.06\nslack_length = 33",
      "law = \"blankevoort\"\nstiffness = 3000\ntransition_strain = 0.9\nslack_length = 33",
      "law = \"abdel-rahman\"\nstiffness = 300\ntoe_stiffness = 200\ntransition_strain = 0.06\nslack_length = 30",
      "law = \"spring\"\nstiffness = 20\nslack_length = 60",
      "law = \"spring\"\nstiffness = 20\nslack_length = 0",
      "law = \"table\"\npoints = [[-0.1, 0], [0, 10], [0.2, 80], [0.9, 500]]\nslack_length = 30",
  };
  for (const char* law : laws) {
    const auto s = scene_model(bone_on_ground("{ z = 40 }") + ligament("cord", "[3, -8, 5]", "[10, 4, -6]", law));
    const double worst = worst_derivative(s, turned(s));
    std::printf("%.1e  %.20s\n", worst, law);
    EXPECT_LT(worst, 1e-8) << law;
  }
}

TEST(PotentialEnergy, OverViaPoints) {
  const auto s =
      scene_model(bone_on_ground("{ z = 40 }") + ligament("cord", "[3, -8, 5]", "[10, 4, -6]",
                                                          "law = \"quadratic\"\nstiffness = 5000\nslack_length = 30\n"
                                                          "via = [{ body = \"bone\", point = [20, 0, -9] }, "
                                                          "{ body = \"ground\", point = [25, 5, 2] }]"));
  EXPECT_LT(worst_derivative(s, turned(s)), 1e-8);
}

TEST(PotentialEnergy, LoadsWithAPotential) {
  const char* loads[] = {
      "force = [10, -20, 30]\npoint = [5, 6, 7]",
      "toward = { body = \"ground\", point = [10, 20, -30] }\nmagnitude = 50\npoint = [5, 6, 7]",
      "force = [10, -20, 30]\npoint = [5, 6, 7]\nscale = { sine = { amplitude = 2, frequency = 0.3 } }",
  };
  for (const char* more : loads) {
    const auto s = scene_model(bone_on_ground("{ z = 40 }") + load("pull", more));
    EXPECT_LT(worst_derivative(s, turned(s), 0.4), 1e-8) << more;
  }
  for (const char* on : {"j.a", "j.b", "j.c", "j.x", "j.y", "j.z"}) {
    const auto s = scene_model(bone_on_ground("{ z = 40 }") + "[load.push]\non = \"" + on + "\"\nvalue = 3\n");
    EXPECT_LT(worst_derivative(s, turned(s)), 1e-8) << on;
  }
}

TEST(PotentialEnergy, WeightsAndHinges) {
  const auto s = scene_model(R"(format = 1
units = { length = "mm", angle = "rad" }
gravity = [1, -2, -9.81]
[body.ground]
fixed = true
[body.bone]
mass = 3
centre_of_mass = [10, -20, 30]
[joint.hinge]
type = "revolute"
parent = "ground"
child = "bone"
axis = [1, 2, 2]
stiffness = 7
reference = { angle = 0.3 }
)");
  State state = reference_state(s.model);
  state.coordinates[0][0] = 0.9;  // about the hinge alone: off it the coordinate held has no energy
  state.poses = poses_from_coordinates(s.model, state.coordinates);
  EXPECT_LT(worst_derivative(s, state), 1e-8);
}

TEST(PotentialEnergy, NoneWhereALoadHasNone) {
  const char* loads[] = {
      "force = [1, 0, 0]\nframe = \"body\"", "moment = [1, 0, 0]",
      "force = [1, 0, 0]\nscale = { over = \"j.a\", table = [[1, 0], [2, 1]] }",  // 0 here, but not beside
  };
  for (const char* more : loads) {
    const auto s = scene_model(bone_on_ground() + load("pull", more));
    Target target = test::target_of(s.scene);
    EXPECT_FALSE(potential_energy(s.model, reference_state(s.model), target).has_value()) << more;
    target.load_factors = {0};
    EXPECT_EQ(potential_energy(s.model, reference_state(s.model), target), 0.0) << more;
  }
}

TEST(PotentialEnergy, LoadsCountTheirWorkSinceTheReferencePose) {
  const auto s = scene_model(bone_on_ground("{ z = 1000 }") + load("pull", "force = [0, 0, 5]"));
  State state = reference_state(s.model);
  EXPECT_EQ(potential_energy(s.model, state, test::target_of(s.scene)), 0.0);
  state.poses[1].p.z() += 0.25;
  EXPECT_DOUBLE_EQ(*potential_energy(s.model, state, test::target_of(s.scene)), -1.25);
}

TEST(PotentialEnergy, NoneWithAnElasticLayer) {
  const auto s = scene_model(bone_on_ground("{ z = 19 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
                             test::surface("floor", "ground", "plane") + test::layer("soft", "ball", "floor") +
                             test::spring("s", "[0, 0, 0]", "[0, 0, -30]", 1, 20));
  EXPECT_FALSE(potential_energy(s.model, reference_state(s.model), test::target_of(s.scene)).has_value());
}

}  // namespace
}  // namespace genu
