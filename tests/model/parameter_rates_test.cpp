#include "genu/model/parameter_rates.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "genu/model/ligament_pieces.h"
#include "support/finite_difference.h"
#include "support/scene_model.h"

namespace genu {
namespace {

/// The knee with loads of every kind, away from any equilibrium, with multipliers.
test::SceneModel loaded_knee() {
  return test::scene_model(test::knee(
      test::load("push", "force = [3, -10, -20]\nmoment = [0.05, 0.02, 0.01]\npoint = [3, 4, 10]") +
      test::load("pull",
                 "point = [1, 2, 30]\ntoward = { body = \"ground\", point = [5, 40, -60] }\nmagnitude = 15\n"
                 "scale = { over = \"knee.flexion\", table = [[0, 0.5], [40, 1], [90, 2]] }") +
      "[load.turn]\non = \"knee.rotation\"\nvalue = 0.1\n" +
      "[[step]]\nprescribe = { \"knee.flexion\" = [0, 10], \"knee.y\" = 2 }\nload = { push = 0.7 }\nincrements = 1\n"));
}

/// A link with weight on a hinge with a spring and limits.
test::SceneModel heavy_hinge() {
  return test::scene_model(R"(format = 1
units = { length = "mm", angle = "deg" }
gravity = [2, -9, 1]
[body.ground]
fixed = true
[body.link]
mass = 2
centre_of_mass = [10, -100, 5]
[joint.h]
type = "revolute"
parent = "ground"
child = "link"
axis = [0, 0, 1]
stiffness = 0.5
limits = { from = -20, to = 30, stiffness = 4 }
)");
}

Eigen::VectorXd stacked(const Linearization& at) {
  Eigen::VectorXd out(at.wrench.size() + at.constraint.size());
  out << at.wrench, at.constraint;
  return out;
}

/// Every derivative of the equations at a state against differences; how many were compared.
int expect_derivatives(const test::SceneModel& s, const Target& target, const State& state) {
  double worst = 0;
  int compared = 0;
  for (const Parameter& p : parameters_of(s.scene)) {
    using Kind = Parameter::Kind;
    // Without contacts and wraps there is nothing to see; an offset is no number of the scene.
    if (p.of_surface() && (s.model.reference_wraps.empty() || p.kind == Kind::offset)) continue;
    const auto residual = [&](double share) {
      const double delta = share * p.change;
      PlacedScene scene = s.scene;
      Target aim = target;
      const auto o = static_cast<std::size_t>(std::max(p.object, 0));
      if (double* number = parameter_number(scene, p)) *number += delta;
      if (p.kind == Kind::factor) aim.load_factors[o] += delta;
      for (auto& q : aim.prescribed)
        if (p.kind == Kind::prescribed && q.coordinate == p.quantity) q.value += delta;
      std::vector<std::shared_ptr<const Surface>> surfaces;
      for (const SurfaceDef& def : scene.surfaces) surfaces.push_back(test::formula_surface(def));
      Diagnostics out;
      Linearization at;
      const auto model = build_model(scene, surfaces, out);
      State there = state;
      settle_wraps(*model, there);
      linearize(*model, there, aim, at);
      return stacked(at);
    };
    const Eigen::VectorXd truth = test::derivative(residual, 0.01);
    Linearization rate;
    residual_rate(s.scene, s.model, state, target, p, rate);
    const Eigen::VectorXd exact = p.change * stacked(rate);
    const double error = (exact - truth).norm() / std::max(truth.norm(), 1e-3);
    EXPECT_LT(error, 1e-7) << p.name << "\n" << exact.transpose() << "\n" << truth.transpose();
    worst = std::max(worst, error);
    ++compared;
  }
  std::printf("%d parameters, worst relative error %.2g\n", compared, worst);
  return compared;
}

TEST(ParameterRates, AreTheDerivativesOfTheEquations) {
  const test::SceneModel s = loaded_knee();
  if (s.scene.bodies.empty()) return;
  const Target target = test::target_of(s.scene, 0.4);
  State state = reference_state(s.model);
  fit_multipliers(s.model, target, state);
  state.multipliers = {0.3, -2};
  state.poses[1] = retract(state.poses[1], (Vec6() << 1e-3, -2e-3, 1e-3, 0.2, -0.1, 0.15).finished());
  update_coordinates(s.model, state);
  EXPECT_GT(expect_derivatives(s, target, state), 70);
}

TEST(ParameterRates, OfWeightsAndOfSpringsAtAndBeyondLimits) {
  const test::SceneModel s = heavy_hinge();
  if (s.scene.bodies.empty()) return;
  const Target target = test::target_of(s.scene);
  for (const double angle : {0.1, 0.7, -0.6}) {  // rad: between the limits, and beyond either
    State state = reference_state(s.model);
    fit_multipliers(s.model, target, state);
    state.poses[1] = retract(state.poses[1], (Vec6() << 1e-3, 2e-3, -1e-3, 0.02, -0.01, angle).finished());
    update_coordinates(s.model, state);
    EXPECT_EQ(expect_derivatives(s, target, state), 4 + 4);  // mass and its place; stiffness and limits
  }
}

/// A bone on ligaments over an ellipsoid of its own and a rod of the ground, and on a cable over the rod.
test::SceneModel wrapped_bone() {
  const std::string ends =
      "from = { body = \"ground\", point = [-40, 3, 2] }\nto = { body = \"bone\", point = [35, -4, 1] }\n";
  const std::string law = "law = \"linear\"\nstiffness = 700\n";
  return test::scene_model(
      test::bone_on_ground() +
      "[surface.rod]\nbody = \"ground\"\nshape = \"cylinder\"\nradius = 9\norigin = [-8, -5, 0]\n" +
      "[surface.egg]\nbody = \"bone\"\nshape = \"ellipsoid\"\nradii = [9, 7, 12]\norigin = [14, -3, 1]\n" +
      "[ligament.l]\n" + ends +
      "wrap = [{ surface = \"rod\", side = [0, 1, 0] }, { surface = \"egg\", side = [0, 1, 0.3] }]\n" + law +
      "reference_strain = 0.08\n" + "[load.cable]\n" + ends +
      "wrap = [{ surface = \"rod\", side = [0, 1, 0] }]\nmagnitude = 12\n");
}

TEST(ParameterRates, OfWrappedLigamentsAndCablesByTheirEndsAndSurfaces) {
  const test::SceneModel s = wrapped_bone();
  if (s.scene.bodies.empty()) return;
  const Target target = test::target_of(s.scene);
  State state = reference_state(s.model);
  fit_multipliers(s.model, target, state);
  state.poses[1] = retract(state.poses[1], (Vec6() << 2e-3, -1e-3, 1e-3, 0.05, -0.04, -0.06).finished());
  update_coordinates(s.model, state);
  settle_wraps(s.model, state);
  for (const WrapTouch& touch : state.wraps) EXPECT_TRUE(touch.touching);
  // Stiffness, strain and ends; radii and origins; magnitude, activation and factor.
  EXPECT_EQ(expect_derivatives(s, target, state), 2 + 6 + 4 + 6 + 3);
}

}  // namespace
}  // namespace genu
