// The pose and its place on the path found together: against the crank's own geometry, and beside poses solved one by
// one.
#include "genu/path/event_newton.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/model/ligament_pieces.h"
#include "support/solved.h"

namespace genu {
namespace {

/// The bone turns about x; a ligament from 30 mm off the axis to 40 mm off it on the ground stretches. Along the axis a
/// spring holds it, and a second ligament pulls at an angle, so that it moves along as it turns.
struct TurnedCrank {
  test::SceneModel scene = test::scene_model(
      test::bone_on_ground("{ a = 1.0 }") + test::spring("centre", "[0, 0, 0]", "[0, 0, 0]", 10, 0) +
      test::ligament("pull", "[0, 30, 0]", "[15, 40, 0]", "law = \"quadratic\"\nstiffness = 2000\nslack_length = 10") +
      test::step("prescribe = { \"j.a\" = [0.5, 1.5], \"j.b\" = 0, \"j.c\" = 0, \"j.y\" = 0, \"j.z\" = 0 }\n"
                 "increments = 1"));
  StepPlan plan = plan_steps(scene.scene)[0];

  State solved(double t) const {
    State state = reference_state(scene.model);
    state.poses[1].R = Eigen::AngleAxisd(0.5 + t, Vec3::UnitX()).toRotationMatrix();
    update_coordinates(scene.model, state);
    Newton newton(scene.model);
    EXPECT_TRUE(newton.solve(state, plan.target(t), {}).converged());
    return state;
  }
  double length(const State& state) const { return scene.model.ligaments[1].path.length(state.poses); }
};

TEST(EventNewton, FindsThePoseWhereALigamentIsAsLongAsAsked) {
  const TurnedCrank crank;
  EventNewton newton(crank.scene.model);
  for (const double truth : {0.2, 0.5, 0.77}) {
    const State there = crank.solved(truth);
    for (const double off : {-0.05, -1e-3, 0.0, 1e-3, 0.05}) {
      // A guess that lies beside the path as well.
      State state = crank.solved(truth + off);
      state.poses[1].p += Vec3(0.2e-3, 0.1e-3, 0) * std::abs(off) * 20;
      double t = truth + off;
      ASSERT_TRUE(newton.solve(crank.plan, {1, crank.length(there), 1e-15, 1e-12}, {}, nullptr, t, state)) << off;
      EXPECT_NEAR(t, truth, 1e-11) << off;
      EXPECT_NEAR((state.poses[1].p - there.poses[1].p).norm(), 0, 1e-12) << off;
      EXPECT_NEAR((state.poses[1].R - there.poses[1].R).norm(), 0, 1e-11) << off;
    }
  }
}

TEST(EventNewton, SaysSoWhereALigamentIsNeverThatLong) {
  const TurnedCrank crank;
  EventNewton newton(crank.scene.model);
  double t = 0.5;
  State state = crank.solved(t);
  EXPECT_FALSE(newton.solve(crank.plan, {1, 1.0, 1e-15, 1e-12}, {}, nullptr, t, state));
}

TEST(EventNewton, CanBeCalledOff) {
  const TurnedCrank crank;
  EventNewton newton(crank.scene.model);
  NewtonOptions options;
  options.cancelled = [] { return true; };
  double t = 0.5;
  State state = crank.solved(t);
  EXPECT_FALSE(newton.solve(crank.plan, {1, 0.03, 1e-15, 1e-12}, options, nullptr, t, state));
}

}  // namespace
}  // namespace genu
