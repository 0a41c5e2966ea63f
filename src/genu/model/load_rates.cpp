#include "genu/model/load_rates.h"

namespace genu {
namespace {

/// make(def) with the number at 1 less make(def) with it at 0.
template <class Def, class Make>
Load slope(Def def, const Parameter& parameter, const Make& make) {
  double& number = kind_of(def).numbers[at(parameter.number)].values(def)[parameter.component];
  number = 0;
  const Load zero = make(def);
  number = 1;
  Load change = make(def);
  change.force -= zero.force;
  change.moment -= zero.moment;
  change.value -= zero.value;
  change.p_A -= zero.p_A;
  change.p_B -= zero.p_B;
  return change;
}

Vec12 dead_rate(const Load& load, const Load& change, const Pose& X_WA) {
  const Vec3 r = X_WA.R * load.p_A, r_rate = X_WA.R * change.p_A;
  Vec12 out = Vec12::Zero();
  out.head<6>() << change.force, change.moment + r_rate.cross(load.force) + r.cross(change.force);
  return out;
}

Vec12 follower_rate(const Load& load, const Load& change, const Pose& X_WA) {
  Vec12 out = Vec12::Zero();
  out.head<6>() << X_WA.R * change.force,
      X_WA.R * (change.moment + change.p_A.cross(load.force) + load.p_A.cross(change.force));
  return out;
}

Vec12 toward_rate(const Load& load, const Load& change, const Pose& X_WA, const Pose& X_WB) {
  const Vec3 r_A = X_WA.R * load.p_A, r_B = X_WB.R * load.p_B;
  const Vec3 end_A = X_WA.R * change.p_A, end_B = X_WB.R * change.p_B;
  const Vec3 line = (X_WB.p - X_WA.p) + (r_B - r_A), line_rate = end_B - end_A;
  const double length = line.norm();
  const Vec3 u = line / length, pull = load.value * u;
  const Vec3 pull_rate = change.value * u + load.value / length * (line_rate - u * u.dot(line_rate));
  Vec12 out;
  out << pull_rate, end_A.cross(pull) + r_A.cross(pull_rate), -pull_rate, -end_B.cross(pull) - r_B.cross(pull_rate);
  return out;
}

}  // namespace

Load load_change(const PlacedScene& scene, const Parameter& parameter) {
  if (parameter.of_body())
    return slope(scene.bodies[at(parameter.object)], parameter,
                 [&](const BodyDef& def) { return make_weight(scene, def, parameter.object); });
  return slope(scene.loads[at(parameter.object)], parameter,
               [&](const LoadDef& def) { return make_unscaled_load(scene, def); });
}

Vec12 load_wrench_rate(const Load& load, const Load& change, const Pose& X_WA, const Pose& X_WB) {
  switch (load.kind) {
    case Load::Kind::dead:
      return dead_rate(load, change, X_WA);
    case Load::Kind::follower:
      return follower_rate(load, change, X_WA);
    case Load::Kind::toward:
      return toward_rate(load, change, X_WA, X_WB);
    case Load::Kind::coordinate:
    case Load::Kind::cable:
      break;
  }
  return Vec12::Zero();
}

}  // namespace genu
