// Two routes to one step, and the step along the path as its tangent.
#include "genu/equilibrium/newton_step.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "support/solved.h"

namespace genu {
namespace {

/// The knee off its solution: a random twist, forces and multiplier.
State shaken(const JointModel& model, const State& state, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Correction change;
  change.resize(1, static_cast<int>(state.multipliers.size()), static_cast<int>(state.contacts.size()));
  for (int i = 0; i < 6; ++i) change.twist[i] = (i < 3 ? 5e-4 : 0.05) * unit(random);
  for (auto& m : change.multipliers) m = 3 * unit(random);
  for (auto& f : change.forces) f = 100 * unit(random);
  for (Vec4& ds : change.surface) ds = Vec4::NullaryExpr([&] { return 5e-4 * unit(random); });
  State out;
  EXPECT_TRUE(retract(model, state, change, 1, out));
  return out;
}

Correction difference(Correction x, const Correction& y) {
  x.twist -= y.twist;
  x.multipliers -= y.multipliers;
  x.forces -= y.forces;
  for (std::size_t c = 0; c < x.surface.size(); ++c) x.surface[c] -= y.surface[c];
  return x;
}

TEST(NewtonStep, EliminatedAndDenseStepsAgree) {
  const auto k = test::solved_knee(30);
  const JointModel& model = k.scene.model;
  ASSERT_EQ(k.pose.state.contacts.size(), 2u);
  std::mt19937 random(31);
  NewtonStep dense(model), eliminated(model);
  double worst = 0;
  for (int i = 0; i < 30; ++i) {
    Linearization at, other;
    linearize(model, shaken(model, k.pose.state, random), k.target, at);
    linearize(model, shaken(model, k.pose.state, random), k.target, other);
    ASSERT_TRUE(dense.factor(at, k.target, NewtonStep::Route::dense));
    ASSERT_TRUE(eliminated.factor(at, k.target, NewtonStep::Route::eliminated));
    EXPECT_EQ(dense.route(), NewtonStep::Route::dense);
    EXPECT_EQ(eliminated.route(), NewtonStep::Route::eliminated);
    for (const Linearization* residual : {&at, &other}) {
      Correction x, y;
      dense.solve(*residual, x);
      eliminated.solve(*residual, y);
      const double error = dense.norm(difference(x, y)) / dense.norm(x);
      const double bound = 1e-12 / std::min(dense.linear().rcond(), 1e-2);
      worst = std::max(worst, error / bound);
      EXPECT_LT(error, bound) << dense.linear().rcond();
    }
    Correction x, y;
    const VecX wrench = VecX::LinSpaced(6, -3, 8), constraint = VecX::Constant(1, 0.4);
    dense.solve_rates(wrench, constraint, x);
    eliminated.solve_rates(wrench, constraint, y);
    EXPECT_LT(dense.norm(difference(x, y)), 1e-12 / dense.linear().rcond() * dense.norm(x));
  }
  EXPECT_LT(worst, 1);
}

TEST(NewtonStep, StepSolvesTheLinearizedEquations) {
  const auto k = test::solved_knee(30);
  std::mt19937 random(32);
  Linearization at;
  linearize(k.scene.model, shaken(k.scene.model, k.pose.state, random), k.target, at);
  NewtonStep step(k.scene.model);
  ASSERT_TRUE(step.factor(at, k.target));
  Correction x;
  step.solve(at, x);
  VecX wrench = at.wrench + at.stiffness * x.twist + at.gradient.transpose() * x.multipliers;
  for (std::size_t c = 0; c < at.contacts.size(); ++c) {
    const ContactBlock& block = at.contacts[c];
    // Bone is a here, ground b.
    ASSERT_EQ(at.contact_bodies[c][1], -1);
    wrench += block.wrench_d_surface.topRows<6>() * x.surface[c] +
              x.forces[static_cast<Eigen::Index>(c)] * block.direction.head<6>();
    const Vec5 residual = block.residual + block.d_twist.leftCols<6>() * x.twist + block.d_surface * x.surface[c];
    EXPECT_LT(residual.norm(), 1e-13);
  }
  EXPECT_LT(wrench.norm(), 1e-10 * at.wrench.norm());
  EXPECT_NEAR(at.constraint[0] + (at.gradient * x.twist)[0], 0, 1e-14);
}

TEST(NewtonStep, RatesAreThePathsTangent) {
  // Poses solved a hundredth of a degree before and after, against the tangent at 30 deg.
  const double h = 1e-2;
  const auto here = test::solved_knee(30), before = test::solved_knee(30 - h), after = test::solved_knee(30 + h);
  const JointModel& model = here.scene.model;
  Linearization at;
  linearize(model, here.pose.state, here.target, at);
  const double span = after.target.prescribed[0].value - before.target.prescribed[0].value;
  for (const auto route : {NewtonStep::Route::dense, NewtonStep::Route::eliminated}) {
    NewtonStep step(model);
    ASSERT_TRUE(step.factor(at, here.target, route));
    Correction tangent;
    step.solve_rates(VecX::Zero(6), VecX::Constant(1, -1), tangent);  // residual = value - target
    const Pose &from = before.pose.state.poses[1], &to = after.pose.state.poses[1];
    EXPECT_LT(((to.p - from.p) / span - tangent.twist.head<3>()).norm(), 1e-6 * tangent.twist.head<3>().norm() + 1e-9);
    EXPECT_LT((log_rotation(to.R * from.R.transpose()) / span - tangent.twist.tail<3>()).norm(), 1e-6);
    const double rate = (after.pose.state.multipliers[0] - before.pose.state.multipliers[0]) / span;
    EXPECT_NEAR(tangent.multipliers[0], rate, 1e-5 * std::abs(rate) + 1e-6);
    for (std::size_t c = 0; c < 2; ++c) {
      const double force = (after.pose.state.contacts[c].force - before.pose.state.contacts[c].force) / span;
      EXPECT_NEAR(tangent.forces[static_cast<Eigen::Index>(c)], force, 1e-5 * std::abs(force) + 1e-4);
    }
  }
}

TEST(NewtonStep, ResidualSeesWhatIsNotANumber) {
  const auto k = test::solved_knee(10);
  Linearization at;
  linearize(k.scene.model, k.pose.state, k.target, at);
  NewtonStep step(k.scene.model);
  EXPECT_LT(step.residual(at, k.target), 1e-11);
  at.wrench[4] = NAN;
  EXPECT_TRUE(std::isnan(step.residual(at, k.target)));
  at.stiffness(2, 2) = NAN;
  EXPECT_FALSE(step.factor(at, k.target));
}

}  // namespace
}  // namespace genu
