#include "genu/model/load_rates.h"

namespace genu {
namespace {

using Kind = Parameter::Kind;

/// A load is linear in its force, moment and magnitude: its derivative is the unit load.
Vec12 unit_wrench(Load load, const Parameter& parameter, const Pose& X_WA, const Pose& X_WB) {
  load.force.setZero();
  load.moment.setZero();
  if (parameter.kind == Kind::force) load.force[parameter.component] = 1;
  if (parameter.kind == Kind::moment) load.moment[parameter.component] = 1;
  if (parameter.kind == Kind::magnitude) load.value = 1;
  return load.between(X_WA, X_WB).wrench;
}

/// Rate of the force toward a point with a moving end.
Vec12 moved_end(const Load& load, const Vec3& end_A, const Vec3& end_B, const Pose& X_WA, const Pose& X_WB) {
  const Vec3 r_A = X_WA.R * load.p_A, r_B = X_WB.R * load.p_B;
  const Vec3 line = (X_WB.p - X_WA.p) + (r_B - r_A), line_rate = end_B - end_A;
  const double length = line.norm();
  const Vec3 u = line / length, pull = load.value * u;
  const Vec3 pull_rate = load.value / length * (line_rate - u * u.dot(line_rate));
  Vec12 out;
  out << pull_rate, end_A.cross(pull) + r_A.cross(pull_rate), -pull_rate, -end_B.cross(pull) - r_B.cross(pull_rate);
  return out;
}

}  // namespace

Vec12 load_wrench_rate(const Load& load, const Parameter& parameter, const Pose& X_WA, const Pose& X_WB) {
  const Vec3 axis = Vec3::Unit(parameter.component);
  const bool near_end = parameter.kind == Kind::point || parameter.kind == Kind::centre_of_mass;
  if (near_end && load.kind == Load::Kind::toward) return moved_end(load, X_WA.R * axis, Vec3::Zero(), X_WA, X_WB);
  if (parameter.kind == Kind::toward_point) return moved_end(load, Vec3::Zero(), X_WB.R * axis, X_WA, X_WB);
  if (!near_end) return unit_wrench(load, parameter, X_WA, X_WB);
  const Vec3 force = load.kind == Load::Kind::follower ? Vec3(X_WA.R * load.force) : load.force;
  Vec12 out = Vec12::Zero();
  out.segment<3>(3) = (X_WA.R * axis).cross(force);
  return out;
}

}  // namespace genu
