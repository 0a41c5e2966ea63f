// The cubic between two poses, against a motion that is known everywhere.
#include "genu/solver/path_cubic.h"

#include <Eigen/Geometry>

#include "support/scene_model.h"

namespace genu {
namespace {

/// A body on a curve, turning about an axis that turns itself, with one multiplier.
struct Known {
  explicit Known(const JointModel& model) : state(reference_state(model)) {
    state.multipliers = {0};
    tangent.resize(1, 1, 0);
  }
  void set(double t) {
    const Vec3 w(0.3 * t, std::sin(t), t * t);
    state.poses[1] = {exp_rotation(w), Vec3(std::cos(t), t * t * t, std::exp(t))};
    state.multipliers[0] = std::sin(3 * t);
    const double h = 1e-6;
    const auto R = [](double s) { return exp_rotation(Vec3(0.3 * s, std::sin(s), s * s)); };
    const Vec3 rate = log_rotation(R(t + h) * R(t - h).transpose()) / (2 * h);
    tangent.twist << -std::sin(t), 3 * t * t, std::exp(t), rate;
    tangent.multipliers << 3 * std::cos(3 * t);
  }
  State state;
  Correction tangent;
};

TEST(PathCubic, ErrsWithTheFourthPowerOfTheSpan) {
  Diagnostics out;
  const auto scene =
      parse_scene(test::bone_on_ground() + test::step("prescribe = { \"j.a\" = [0, 1] }\nincrements = 1"), "s", out);
  ASSERT_TRUE(scene);
  const JointModel model = *build_model(*scene, {}, out);
  double last = 0;
  for (const double span : {0.2, 0.1, 0.05}) {
    Known from(model), to(model), here(model);
    from.set(0.4);
    to.set(0.4 + span);
    here.set(0.4 + 0.3 * span);
    PathCubic cubic(model, from.state, from.tangent, to.state, to.tangent, span);
    State found;
    ASSERT_TRUE(cubic.at(1, found));
    EXPECT_LT((found.poses[1].R - to.state.poses[1].R).norm(), 1e-14);
    ASSERT_TRUE(cubic.at(0.3, found));
    const double error = (found.poses[1].p - here.state.poses[1].p).norm() +
                         (found.poses[1].R - here.state.poses[1].R).norm() +
                         std::abs(found.multipliers[0] - here.state.multipliers[0]);
    if (last > 0) {
      EXPECT_GT(last / error, 12) << span;
    }
    last = error;
  }
  EXPECT_LT(last, 1e-5);
}

}  // namespace
}  // namespace genu
