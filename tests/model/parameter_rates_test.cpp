#include "genu/model/parameter_rates.h"

#include <cstdio>

#include <gtest/gtest.h>

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

TEST(ParameterRates, AreTheDerivativesOfTheEquations) {
  test::SceneModel s = loaded_knee();
  if (s.scene.bodies.empty()) return;
  const Target target = test::target_of(s.scene, 0.4);
  State state = reference_state(s.model);
  fit_multipliers(s.model, target, state);
  state.multipliers = {0.3, -2};
  state.poses[1] = retract(state.poses[1], (Vec6() << 1e-3, -2e-3, 1e-3, 0.2, -0.1, 0.15).finished());
  update_coordinates(s.model, state);
  double worst = 0;
  int compared = 0;
  for (const Parameter& p : parameters_of(s.scene)) {
    if (p.of_surface()) continue;  // without contacts nothing to see
    using Kind = Parameter::Kind;
    const auto residual = [&](double share) {
      const double delta = share * p.change;
      Scene scene = s.scene;
      Target aim = target;
      const auto o = static_cast<std::size_t>(std::max(p.object, 0));
      if (p.kind == Kind::law_number) scene.ligaments[o].numbers[0].value += delta;
      if (p.kind == Kind::reference_strain) scene.ligaments[o].rest_value += delta;
      if (p.kind == Kind::from_point) scene.ligaments[o].from.point[p.component] += delta;
      if (p.kind == Kind::to_point) scene.ligaments[o].to.point[p.component] += delta;
      if (p.kind == Kind::force) scene.loads[o].force[p.component] += delta;
      if (p.kind == Kind::moment) scene.loads[o].moment[p.component] += delta;
      if (p.kind == Kind::point) scene.loads[o].point[p.component] += delta;
      if (p.kind == Kind::toward_point) scene.loads[o].toward_point[p.component] += delta;
      if (p.kind == Kind::magnitude) scene.loads[o].value += delta;
      if (p.kind == Kind::factor) aim.load_factors[o] += delta;
      for (auto& q : aim.prescribed)
        if (p.kind == Kind::prescribed && q.coordinate == p.quantity) q.value += delta;
      std::vector<std::shared_ptr<const Surface>> surfaces;
      for (const SurfaceDef& def : scene.surfaces) surfaces.push_back(test::formula_surface(def));
      Diagnostics out;
      Linearization at;
      linearize(*build_model(scene, surfaces, out), state, aim, at);
      return Eigen::VectorXd((Eigen::VectorXd(8) << at.wrench, at.constraint).finished());
    };
    const Eigen::VectorXd truth = test::derivative(residual, 0.01);
    Linearization rate;
    residual_rate(s.scene, s.model, state, target, p, rate);
    const Eigen::VectorXd exact = p.change * (Eigen::VectorXd(8) << rate.wrench, rate.constraint).finished();
    const double error = (exact - truth).norm() / std::max(truth.norm(), 1e-3);
    EXPECT_LT(error, 1e-7) << p.name << "\n" << exact.transpose() << "\n" << truth.transpose();
    worst = std::max(worst, error);
    ++compared;
  }
  std::printf("%d parameters, worst relative error %.2g\n", compared, worst);
  EXPECT_GT(compared, 70);
}

}  // namespace
}  // namespace genu
