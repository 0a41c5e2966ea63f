// Newton's convergence on smooth scenes, and on those where a contact leaves directions open.
#include "genu/equilibrium/newton.h"

#include <algorithm>
#include <cmath>

#include <cstdio>

#include <gtest/gtest.h>

#include "genu/core/units.h"
#include "support/solved.h"

namespace genu {
namespace {

using test::bone_on_ground;
using test::contact;
using test::load;
using test::surface;

TEST(Newton, ConvergesQuadraticallyOnTheKnee) {
  int seen = 0;
  for (const double flexion : {5.0, 25.0, 45.0, 65.0}) {
    auto k = test::solved_knee(flexion);
    Newton newton(k.scene.model);
    for (const double off : {0.01, 0.05, 0.1}) {
      State state = k.pose.state;
      Target target = k.target;
      target.prescribed[0].value += off;
      const NewtonReport report = newton.solve(state, target, {});
      ASSERT_TRUE(report.converged()) << to_string(report.outcome);
      EXPECT_LE(report.iterations, 8);
      EXPECT_LT(report.residual, 1e-12);
      const double before = report.residual_history[1], after = report.residual_history[2];
      if (before > 1e-3) continue;
      ++seen;
      EXPECT_LE(after, 1e3 * before * before + 1e-12) << flexion << ' ' << off << ": " << before << " to " << after;
    }
  }
  EXPECT_GE(seen, 8);
}

TEST(Newton, RoutesReachTheSamePose) {
  auto k = test::solved_knee(40);
  Newton newton(k.scene.model);
  State states[2] = {k.pose.state, k.pose.state};
  NewtonOptions options;
  k.target.prescribed[0].value += 0.05;
  for (int i = 0; i < 2; ++i) {
    options.route = i == 0 ? NewtonStep::Route::dense : NewtonStep::Route::eliminated;
    ASSERT_TRUE(newton.solve(states[i], k.target, options).converged());
  }
  EXPECT_LT((states[0].poses[1].p - states[1].poses[1].p).norm(), 1e-14);
  EXPECT_LT((states[0].poses[1].R - states[1].poses[1].R).norm(), 1e-12);
  EXPECT_NEAR(states[0].contacts[0].force, states[1].contacts[0].force, 1e-8);
}

TEST(Newton, FailureLeavesTheStateAsItWas) {
  // Nothing carries the load.
  const auto s = test::scene_model(bone_on_ground("{ z = 3 }") + load("w", "force = [0, 0, -10]"));
  State state = reference_state(s.model);
  const Pose before = state.poses[1];
  Newton newton(s.model);
  const NewtonReport report = newton.solve(state, test::target_of(s.scene), {});
  EXPECT_FALSE(report.converged());
  EXPECT_FALSE(to_string(report.outcome).empty());
  EXPECT_EQ(state.poses[1].p, before.p);
  EXPECT_EQ(state.poses[1].R, before.R);
  // And an angle out of reach of the iterations allowed.
  auto k = test::solved_knee(10);
  State knee = k.pose.state;
  k.target.prescribed[0].value += 3;
  NewtonOptions options;
  options.max_iterations = 4;
  EXPECT_EQ(Newton(k.scene.model).solve(knee, k.target, options).outcome, NewtonReport::Outcome::iterations_used_up);
  EXPECT_EQ(knee.poses[1].p, k.pose.state.poses[1].p);
  EXPECT_EQ(knee.multipliers, k.pose.state.multipliers);
  EXPECT_EQ(knee.contacts[0].force, k.pose.state.contacts[0].force);
  EXPECT_EQ(knee.contacts[1].geometry.a.p, k.pose.state.contacts[1].geometry.a.p);
}

TEST(Newton, TangentBasesThatJumpCostNothing) {
  // A surface's tangent basis is no smooth field: a ball's switches where n_z changes sign in its own frame. Turning
  // the ball a little over the floor must take the same iterations there as anywhere else.
  const auto iterations = [](double turn) {
    const auto s =
        test::scene_model(test::held_ball("[[step]]\nprescribe = { \"j.a\" = " + std::to_string(turn) + " }\n"));
    State state = reference_state(s.model);
    state.poses[1].R = exp_rotation({turn, 0, 0});
    update_coordinates(s.model, state);
    test::hold(s.model, state, 0, Vec3::Zero());
    Target target = test::target_of(s.scene);
    target.load_factors = {0};
    Newton newton(s.model);
    EXPECT_TRUE(newton.solve(state, target, {}).converged()) << turn;
    target.prescribed[0].value = turn + 0.05;
    NewtonOptions short_of_rounding;  // forces are 1e4 times the scale here
    short_of_rounding.residual_tolerance = 1e-10;
    const NewtonReport report = newton.solve(state, target, short_of_rounding);
    EXPECT_TRUE(report.converged()) << turn << ": " << to_string(report.outcome);
    std::printf("turn %.2f: %d iterations\n", turn, report.iterations);
    return report.iterations;
  };
  int least = 100, most = 0;
  // The floor's normal is n_z = 0 in the ball at a turn of pi / 2.
  for (const double turn : {0.2, 0.6, 1.0, 1.52, 1.55, 1.57, 1.9}) {
    const int taken = iterations(turn);
    least = std::min(least, taken);
    most = std::max(most, taken);
  }
  EXPECT_LE(most, least + 1) << "least " << least;
}

/// Solves a scene of one pair held closed at x (m, world), within a slide of 2 mm of where it belongs (the cap of one
/// iteration), and expects `force` (N) within 6 iterations.
State expect_degenerate(const test::SceneModel& s, const Vec3& x, double force) {
  State state = reference_state(s.model);
  test::hold(s.model, state, 0, x);
  Newton newton(s.model);
  const NewtonReport report = newton.solve(state, test::target_of(s.scene), {});
  EXPECT_TRUE(report.converged()) << to_string(report.outcome) << ", residual " << report.residual;
  EXPECT_LE(report.iterations, 6);
  EXPECT_NEAR(state.contacts[0].force, force, 1e-8 * force);
  return state;
}

TEST(Newton, PlateOnAPlane) {
  const auto s = test::scene_model(bone_on_ground() +
                                   surface("plate", "bone", "plane", "z_axis = [0, 0, -1]\nx_axis = [1, 0, 0]") +
                                   surface("floor", "ground", "plane") + contact("c", "plate", "floor") +
                                   load("w", "force = [0, 0, -100]\npoint = [1, 1.5, 10]"));
  const State state = expect_degenerate(s, Vec3::Zero(), 100);
  // The force stands under the load.
  EXPECT_LT((test::contact_point(s.model, state) - state.poses[1] * Vec3(1e-3, 1.5e-3, 0)).norm(), 1e-9);
  EXPECT_NEAR(state.poses[1].p.z(), 0, 1e-12);
}

TEST(Newton, CylinderOnAPlane) {
  const auto s =
      test::scene_model(bone_on_ground("{ z = 10 }") +
                        surface("roll", "bone", "cylinder", "z_axis = [1, 0, 0]\nx_axis = [0, 1, 0]\nradius = 10") +
                        surface("floor", "ground", "plane") + contact("c", "roll", "floor") +
                        load("w", "force = [0, 0, -100]\npoint = [5, 0, 0]"));
  const State state = expect_degenerate(s, {0, 0, 0}, 100);
  EXPECT_NEAR(test::contact_point(s.model, state).x(), (state.poses[1] * Vec3(5e-3, 0, 0)).x(), 1e-9);
}

TEST(Newton, BallInASocketOfLittleClearance) {
  for (const double clearance : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    SCOPED_TRACE(clearance);
    const Vec3 load(0.6, -0.9, -10);
    const double radius = 20, slack = radius * clearance;
    const auto s = test::scene_model(
        bone_on_ground("{ z = " + std::to_string(-slack) + " }") + surface("ball", "bone", "sphere", "radius = 20") +
        surface("cup", "ground", "sphere", "inside = true\nradius = " + std::to_string(radius + slack)) +
        contact("c", "ball", "cup") + test::load("w", "force = [0.6, -0.9, -10]"));
    const State state = expect_degenerate(s, {1e-3, 0, -0.02}, load.norm());
    const Vec3 expected = 1e-3 * slack * load.normalized();
    EXPECT_LT((state.poses[1].p - expected).norm(), 1e-6 * expected.norm() + 1e-15) << state.poses[1].p.transpose();
  }
}

/// Links on bushings, bent to an arch that a load presses down in long steps.
std::string pressed_arch(int links) {
  std::string text = "format = 1\nunits = { length = \"mm\", angle = \"deg\" }\n[body.b0]\nfixed = true\n";
  const auto bushing = [](const std::string& name, const std::string& from, const std::string& to) {
    return "[bushing." + name + "]\nfrom = { body = \"" + from + "\" }\nto = { body = \"" + to +
           "\" }\nstiffness = [500, 500, 500]\nrotation_stiffness = [0.002, 0.002, 0.002]\n";
  };
  double before = 0;
  for (int i = 1; i <= links; ++i) {
    const std::string k = std::to_string(i), parent = "b" + std::to_string(i - 1);
    const double slope = std::atan(16.0 / 60 * (1 - 2 * (i - 0.5) / links)) / units::kDegree, turn = slope - before,
                 length = 60.0 / links;
    before = slope;
    text += "[body.b" + k + "]\n[joint.j" + k + "]\ntype = \"free\"\nparent = \"" + parent + "\"\nchild = \"b" + k +
            "\"\nrotations = [\"a z\", \"b x\", \"c y\"]\ntranslations = [\"x\", \"y\", \"z\"]\nreference = { a = " +
            std::to_string(turn) + ", x = " + std::to_string(length * std::cos(turn * units::kDegree)) +
            ", y = " + std::to_string(length * std::sin(turn * units::kDegree)) + " }\n" +
            bushing("k" + k, parent, "b" + k);
  }
  return text + bushing("tip", "b0", "b" + std::to_string(links)) + "[load.pull]\nbody = \"b" +
         std::to_string(links / 2) + "\"\nforce = [0, -20, 0]\n[[step]]\nload = { pull = [0, 1] }\nincrements = 200\n";
}

/// One lucky step with a Jacobian does not make it good for the next ones.
TEST(Newton, PosesOfManyBodiesAreAsAccurateAsTheirTolerance) {
  for (const int links : {9, 12, 20}) {
    const test::Followed path = test::follow(pressed_arch(links));
    ASSERT_TRUE(path.result.complete) << path.story();
    double worst = 0;
    for (const PosePoint& point : path.points) worst = std::max(worst, point.report.newton.residual);
    EXPECT_LT(worst, 1e-11) << links;
  }
}

}  // namespace
}  // namespace genu
