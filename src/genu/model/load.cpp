#include "genu/model/load.h"

#include <algorithm>

#include "genu/scene/tolerances.h"

namespace genu {
namespace {

LoadWrench dead_wrench(const Load& load, const Pose& X_WA) {
  const Vec3 r = X_WA.R * load.p_A;
  LoadWrench out;
  out.wrench.head<6>() << load.force, load.moment + r.cross(load.force);
  out.stiffness.block<3, 3>(3, 3) = skew(load.force) * skew(r);  // the lever arm rotates: (w x r) x f
  return out;
}

LoadWrench follower_wrench(const Load& load, const Pose& X_WA) {
  const Vec3 force = X_WA.R * load.force, moment = X_WA.R * (load.moment + load.p_A.cross(load.force));
  LoadWrench out;
  out.wrench.head<6>() << force, moment;
  out.stiffness.block<3, 3>(0, 3) = -skew(force);  // the whole wrench rotates: w x
  out.stiffness.block<3, 3>(3, 3) = -skew(moment);
  return out;
}

LoadWrench toward_wrench(const Load& load, const Pose& X_WA, const Pose& X_WB) {
  const Vec3 r_A = X_WA.R * load.p_A, r_B = X_WB.R * load.p_B;
  const Vec3 d = (X_WB.p - X_WA.p) + (r_B - r_A);
  const double length = d.norm();
  LoadWrench out;
  if (!(length > kCoincidentDistance)) return out;
  const Vec3 u = d / length, t = load.value * u;
  Eigen::Matrix<double, 3, 12> d_twist;  // of d: point velocities v + w x r
  d_twist << -Mat3::Identity(), skew(r_A), Mat3::Identity(), -skew(r_B);
  const Mat3 turning = load.value / length * (Mat3::Identity() - u * u.transpose());
  out.wrench = -d_twist.transpose() * t;
  out.stiffness = -d_twist.transpose() * (turning * d_twist);
  out.stiffness.block<3, 3>(3, 3) += skew(t) * skew(r_A);  // the lever arms rotate
  out.stiffness.block<3, 3>(9, 9) -= skew(t) * skew(r_B);
  return out;
}

}  // namespace

LoadWrench Load::between(const Pose& X_WA, const Pose& X_WB) const {
  switch (kind) {
    case Kind::dead:
      return dead_wrench(*this, X_WA);
    case Kind::follower:
      return follower_wrench(*this, X_WA);
    case Kind::toward:
      return toward_wrench(*this, X_WA, X_WB);
    case Kind::coordinate:
    case Kind::cable:
      break;
  }
  return {};
}

LoadWrench Load::on_coordinate(const JointPoint& joint) const {
  return {value * joint.gradient(coordinate.index).transpose(), value * joint.hessian(coordinate.index)};
}

double Load::largest_force(double length) const {
  const bool on_angle = kind == Kind::coordinate && coordinate.index < 3;
  const double largest = std::max({force.norm(), moment.norm() / length, std::abs(value) / (on_angle ? length : 1)});
  return (scale ? scale->largest() : 1) * largest;
}

Load make_unscaled_load(const PlacedScene& scene, const LoadDef& def) {
  Load load;
  load.name = def.name;
  load.body_a = def.body;
  load.p_A = def.point;
  load.force = def.force;
  load.moment = def.moment;
  load.value = def.activation * def.value;
  load.coordinate = def.coordinate;
  switch (def.kind) {
    case LoadDef::Kind::wrench:
      load.kind = def.frame == LoadDef::Frame::body ? Load::Kind::follower : Load::Kind::dead;
      break;
    case LoadDef::Kind::toward:
      load.kind = Load::Kind::toward;
      load.body_b = def.toward_body;
      load.p_B = def.toward_point;
      break;
    case LoadDef::Kind::cable:
      load.kind = Load::Kind::cable;
      break;
    case LoadDef::Kind::coordinate:
      load.kind = Load::Kind::coordinate;
      load.body_a = scene.joints[static_cast<std::size_t>(def.coordinate.joint)].parent;
      load.body_b = scene.joints[static_cast<std::size_t>(def.coordinate.joint)].child;
      break;
  }
  return load;
}

std::optional<Load> make_load(const PlacedScene& scene, const LoadDef& def, std::string& why) {
  Load load = make_unscaled_load(scene, def);
  if (!def.scale) return load;
  load.scale = LoadScale::make(*def.scale, why);
  return load.scale ? std::optional(load) : std::nullopt;
}

Load make_weight(const PlacedScene& scene, const BodyDef& def, int body) {
  Load load;
  load.name = "weight of " + def.name;
  load.body_a = body;
  load.p_A = def.centre_of_mass;
  load.force = def.mass * scene.gravity.value_or(Vec3::Zero());
  return load;
}

}  // namespace genu
