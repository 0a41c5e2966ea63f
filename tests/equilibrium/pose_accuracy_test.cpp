// How far a pose is from the solution and its forces from theirs: never farther than is said, where the solution is
// known, whatever residual Newton's method stopped at.
#include "genu/equilibrium/pose_accuracy.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "genu/equilibrium/newton.h"
#include "support/solved.h"

namespace genu {
namespace {

using test::bone_on_ground;
using test::contact;
using test::load;
using test::spring;
using test::step;
using test::surface;

/// A ball of 10 mm in a dish, drawn aside by springs, and upright.
std::string ball() {
  return bone_on_ground("{ z = 10 }") + surface("ball", "bone", "sphere", "radius = 10") +
         surface("dish", "ground", "sphere", "radius = 40\norigin = [0, 0, 40]\ninside = true") +
         contact("c", "ball", "dish") + spring("s", "[0, 0, 0]", "[30, 10, 20]", 0.5, 20) +
         spring("t", "[0, 0, 0]", "[-30, 5, 20]", 0.2, 20) + load("w", "force = [0, 0, -40]") +
         step("prescribe = { " + std::string(test::kNoTurn) + " }");
}

struct Solved {
  State state;
  double residual = 0;
};

Solved solved_to(const test::SceneModel& s, const State& start, const Target& target, double tolerance) {
  Solved out{start, 0};
  Newton newton(s.model);
  NewtonOptions options;
  options.residual_tolerance = options.residual_floor = tolerance;
  const NewtonReport report = newton.solve(out.state, target, options);
  EXPECT_TRUE(report.converged());
  out.residual = report.residual;
  return out;
}

TEST(PoseAccuracy, BoundsTheErrorOfAPoseStoppedAtAnyResidual) {
  const auto w = test::follow(ball());
  ASSERT_TRUE(w.result.complete) << w.story();
  const auto s = test::scene_model(ball());
  const Target target = test::target_of(s.scene);
  State start = w.points[0].pose.state;
  const State exact = start;
  Correction away;
  away.resize(s.model.moving_count, static_cast<int>(constraint_count(s.model, target)),
              static_cast<int>(start.contacts.size()));
  away.twist << 2e-4, 1e-4, 0, 0, 0, 0;
  away.multipliers.setZero();
  away.forces.setZero();
  for (Vec4& slide : away.surface) slide.setZero();
  ASSERT_TRUE(retract(s.model, exact, away, 1, start));
  int looked_at = 0;
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-6, 1e-9}) {
    const Solved found = solved_to(s, start, target, tolerance);
    Linearization at;
    linearize(s.model, found.state, target, at);
    const PoseAccuracy accuracy(s.model, target, at);
    double off = 0;  // m, of the one that moves
    for (std::size_t b = 0; b < exact.poses.size(); ++b)
      off = std::max(off, (found.state.poses[b].p - exact.poses[b].p).norm());
    EXPECT_LE(off, accuracy.reach().twist.norm() + 1e-14) << tolerance;
    EXPECT_LE(accuracy.reach().twist.norm(), 1e3 * off + 1e-12) << tolerance << ": and no more than it takes";
    EXPECT_LE(std::abs(found.state.contacts[0].force - exact.contacts[0].force), accuracy.of_contact(0) + 1e-12)
        << tolerance;
    looked_at += off > 1e-12;
  }
  EXPECT_GE(looked_at, 2) << "poses that are not exact";
}

TEST(PoseAccuracy, ACoarserResidualWidensWhatIsLookedAt) {
  const auto s = test::scene_model(ball());
  const NonsmoothReach usual = PoseAccuracy::widest_reach(s.model, 1e-12),
                       bound = PoseAccuracy::widest_reach(s.model, 1e-9),
                       coarse = PoseAccuracy::widest_reach(s.model, 1e-4);
  EXPECT_DOUBLE_EQ(usual.most, bound.most);
  EXPECT_DOUBLE_EQ(coarse.most, 1e5 * usual.most);
  EXPECT_DOUBLE_EQ(coarse.little, 1e5 * usual.little);
  EXPECT_DOUBLE_EQ(PoseAccuracy::least_told(s.model, 1e-4), coarse.little);
}

}  // namespace
}  // namespace genu
