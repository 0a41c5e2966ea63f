// A motion that is known everywhere, with its tangent: for tests of what a path is between and beyond its poses.
#pragma once

#include <cmath>

#include <gtest/gtest.h>

#include "genu/model/build_model.h"
#include "genu/model/correction.h"
#include "support/scene_model.h"

namespace genu::test {

/// A body on a curve, turning about an axis that turns itself, with one multiplier, at t.
struct KnownMotion {
  KnownMotion(const JointModel& model, double t) : state(reference_state(model)) {
    const auto R = [](double s) { return exp_rotation(Vec3(0.3 * s, std::sin(s), s * s)); };
    const double h = 1e-6;
    state.poses[1] = {R(t), Vec3(std::cos(t), t * t * t, std::exp(t))};
    state.multipliers = {std::sin(3 * t)};
    tangent.resize(1, 1, 0);
    tangent.twist << -std::sin(t), 3 * t * t, std::exp(t), log_rotation(R(t + h) * R(t - h).transpose()) / (2 * h);
    tangent.multipliers << 3 * std::cos(3 * t);
  }
  State state;
  Correction tangent;
};

inline double distance(const KnownMotion& motion, const State& state) {
  return (motion.state.poses[1].p - state.poses[1].p).norm() + (motion.state.poses[1].R - state.poses[1].R).norm() +
         std::abs(motion.state.multipliers[0] - state.multipliers[0]);
}

/// A bone of which one angle is prescribed.
inline JointModel one_bone() {
  Diagnostics out;
  const auto scene = parse_scene(bone_on_ground() + step("prescribe = { \"j.a\" = [0, 1] }\nincrements = 1"), "s", out);
  EXPECT_TRUE(scene);
  return *build_model(place(*scene), {}, out);
}

}  // namespace genu::test
