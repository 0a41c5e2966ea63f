#include "genu/osim/skeleton.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "genu/osim/frames.h"
#include "genu/osim/joint_kinds.h"
#include "genu/osim/tolerances.h"
#include "genu/scene/words.h"

namespace genu::osim {
namespace {

double value_of(const Axis& axis, const CoordinateValues& values) {
  const auto found = values.find(axis.coordinate);
  return axis.function(found == values.end() ? 0 : found->second);
}

std::vector<std::string> names_of_joints(const Model& model) {
  std::vector<std::string> names;
  for (const Joint& j : model.joints) names.push_back(j.name);
  return names;
}

}  // namespace

bool is_angle(const Model& model, const std::string& coordinate) {
  for (const Joint& joint : model.joints)
    for (const Axis& axis : joint.rotations)
      if (axis.coordinate == coordinate) return true;
  return false;
}

Pose joint_pose(const Joint& joint, const CoordinateValues& values) {
  Pose X;
  for (const Axis& axis : joint.rotations) X.R = X.R * exp_rotation(value_of(axis, values) * axis.direction);
  for (const Axis& axis : joint.translations) X.p += value_of(axis, values) * axis.direction;
  return X;
}

void Skeleton::refuse(Diagnostics& out, Code code, const SourceLocation& where, const std::string& key,
                      const std::string& found, const std::string& rule) const {
  out.add(error_at({model_->file, where}, code, key, found, rule));
}

double Skeleton::value(const std::string& coordinate) const {
  const auto found = values_.find(coordinate);
  return found == values_.end() ? 0 : found->second;
}

bool Skeleton::moves(const std::string& coordinate) const {
  return std::any_of(joints_.begin(), joints_.end(), [&](const MovingJoint& j) { return j.has(coordinate); });
}

const Coupler* Skeleton::driver_of(const std::string& coordinate) const {
  for (const Coupler& c : model_->couplers)
    if (c.enforced && c.dependent == coordinate) return &c;
  return nullptr;
}

bool Skeleton::follows_what_moves(const std::string& coordinate) const {
  const Coupler* driver = driver_of(coordinate);
  while (driver != nullptr && !moves(driver->independent)) driver = driver_of(driver->independent);
  return driver != nullptr;
}

bool Skeleton::moves_joint(const std::string& joint) const {
  return std::any_of(joints_.begin(), joints_.end(),
                     [&](const MovingJoint& j) { return model_->joints[at(j.joint)].name == joint; });
}

PlacedFrame Skeleton::frame(const std::string& path) const { return find_frame(*model_, path).value(); }

const std::string& Skeleton::body_name(int body) const {
  static const std::string ground = "ground";
  return at(body) < model_->bodies.size() ? model_->bodies[at(body)].name : ground;
}

Pose Skeleton::rigid_in_ground(int rigid) const {
  const int body = bodies_[at(rigid)].bodies.front();
  return in_ground_[at(body)] * in_rigid(body).inverse();
}

bool Skeleton::link_joints(Diagnostics& out) {
  std::vector<const Joint*> mover(model_->bodies.size(), nullptr);
  for (const Joint& joint : model_->joints) {
    const PlacedFrame parent = frame(joint.parent), child = frame(joint.child);
    if (at(child.body) == model_->bodies.size())
      refuse(out, Code::not_built, joint.where, joint.type + " " + joint.name, joint.child,
             "is the ground, as the child of a joint: turn the joint round");
    else if (const Joint* other = std::exchange(mover[at(child.body)], &joint))
      refuse(out, Code::not_built, joint.where, joint.type + " " + joint.name, joint.child,
             fmt::format("is moved by the joint {} too: genu reads no loops", other->name));
    links_.push_back({parent, child});
  }
  return !out.has_errors();
}

/// A coordinate that is frozen follows what drives it, through as many couplers as there are; they make no circle.
double Skeleton::settled(const std::string& coordinate, const CoordinateValues& values) const {
  std::vector<const Coupler*> chain;
  std::string first = coordinate;
  while (values.count(first) == 0 && !moves(first)) {
    const Coupler* driver = driver_of(first);
    if (driver == nullptr) break;
    chain.push_back(driver);
    first = driver->independent;
  }
  double found = value(first);
  for (auto link = chain.rbegin(); link != chain.rend(); ++link) found = (*link)->function(found);
  return found;
}

void Skeleton::settle_values(const CoordinateValues& values) {
  for (const Joint& joint : model_->joints)
    for (const Coordinate& c : joint.coordinates) values_[c.name] = c.default_value;
  for (const auto& [name, value] : values)
    if (const auto known = values_.find(name); known != values_.end()) known->second = value;
  CoordinateValues driven;
  for (const Coupler& c : model_->couplers)
    if (c.enforced) driven[c.dependent] = settled(c.dependent, values);
  for (const auto& [name, value] : driven) values_[name] = value;
}

bool Skeleton::choose_joints(const std::vector<std::string>& names, Diagnostics& out) {
  const std::vector<std::string> known = names_of_joints(*model_);
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      out.add(error_at({}, Code::unknown_name, "--joints", name,
                       "is no joint of " + model_->file + did_you_mean(name, known) +
                           (known.empty() ? "" : "; its joints: " + quoted_list(known))));
  for (std::size_t j = 0; j < model_->joints.size(); ++j) {
    const Joint& joint = model_->joints[j];
    const bool asked = std::find(names.begin(), names.end(), joint.name) != names.end();
    if (!asked && !names.empty()) continue;
    MovingJoint moving;
    std::string why_not;
    const bool can = read_kind(joint, moving, why_not);
    moving.joint = static_cast<int>(j);
    if (asked && !can)
      refuse(out, Code::not_built, joint.where, joint.type + " " + joint.name, {},
             why_not + "; leave it out of --joints, and it is frozen");
    const bool on_ground = at(links_[j].parent.body) == model_->bodies.size();
    if (can && (asked || (moving.kind == MovingJoint::Kind::free && !on_ground))) joints_.push_back(moving);
  }
  const auto place = [&](const MovingJoint& m) {  // as asked
    return std::find(names.begin(), names.end(), model_->joints[at(m.joint)].name) - names.begin();
  };
  std::stable_sort(joints_.begin(), joints_.end(),
                   [&](const MovingJoint& a, const MovingJoint& b) { return place(a) < place(b); });
  if (joints_.empty() && !out.has_errors())
    out.add(error_at(
        {}, Code::missing_key, "--joints", {},
        "is needed: no joint of the model has six free axes between two bodies; its joints: " + quoted_list(known)));
  return !out.has_errors();
}

bool Skeleton::place_bodies(Diagnostics& out) {
  const std::size_t ground = model_->bodies.size();
  in_ground_.assign(ground + 1, {});
  std::vector<bool> placed(ground + 1, false);
  placed[ground] = true;
  for (bool more = true; more;) {
    more = false;
    for (std::size_t j = 0; j < links_.size(); ++j) {
      const Link& link = links_[j];
      if (!placed[at(link.parent.body)] || placed[at(link.child.body)]) continue;
      in_ground_[at(link.child.body)] = in_ground_[at(link.parent.body)] * link.parent.X_body_frame *
                                        joint_pose(model_->joints[j], values_) * link.child.X_body_frame.inverse();
      placed[at(link.child.body)] = more = true;
      order_.push_back(static_cast<int>(j));
    }
  }
  for (std::size_t b = 0; b < ground; ++b)
    if (!placed[b])
      refuse(out, Code::not_built, model_->bodies[b].where, "Body " + model_->bodies[b].name, {},
             "hangs on no joint, or on a loop of joints that does not reach the ground");
  return !out.has_errors();
}

void Skeleton::unite_bodies() {
  const std::size_t ground = model_->bodies.size();
  rigid_of_.assign(ground + 1, -1);
  bodies_.assign(1, {});
  bodies_[0].fixed = true;
  bodies_[0].bodies = {static_cast<int>(ground)};
  rigid_of_[ground] = 0;
  for (const int j : order_) {
    const int parent = rigid_of_[at(links_[at(j)].parent.body)], child = links_[at(j)].child.body;
    int rigid = parent;
    for (MovingJoint& moving : joints_) {
      if (moving.joint != j) continue;
      rigid = static_cast<int>(bodies_.size());
      bodies_.emplace_back();
      bodies_.back().named_after = child;
      moving.parent = parent;
      moving.child = rigid;
      if (bodies_[at(parent)].named_after < 0) bodies_[at(parent)].named_after = links_[at(j)].parent.body;
    }
    rigid_of_[at(child)] = rigid;
    bodies_[at(rigid)].bodies.push_back(child);
  }
}

bool Skeleton::frame_joint(MovingJoint& moving, std::vector<bool>& framed, std::vector<Pose>& X_ground_rigid,
                           Diagnostics& out) {
  const Joint& joint = model_->joints[at(moving.joint)];
  const Link& link = links_[at(moving.joint)];
  const Pose X_ground_parent = in_ground_[at(link.parent.body)] * link.parent.X_body_frame;
  const Pose X_ground_child = in_ground_[at(link.child.body)] * link.child.X_body_frame;
  Pose& parent = X_ground_rigid[at(moving.parent)];
  if (!framed[at(moving.parent)]) parent = X_ground_parent;
  framed[at(moving.parent)] = framed[at(moving.child)] = true;
  const Pose X_parent_frame = parent.inverse() * X_ground_parent;
  if (moving.kind == MovingJoint::Kind::free) {
    X_ground_rigid[at(moving.child)] = X_ground_child;
    const double apart =
        std::max((X_parent_frame.R - Mat3::Identity()).cwiseAbs().maxCoeff(), X_parent_frame.p.cwiseAbs().maxCoeff());
    if (apart <= kSameFrame) return true;
    refuse(out, Code::not_built, joint.where, joint.type + " " + joint.name, joint.parent,
           "differs from the frame of another joint on the same rigid body: genu's free joints have no offset frames; "
           "import them one at a time");
    return false;
  }
  CoordinateValues at_zero = values_;
  at_zero[moving.angle] = 0;
  const Pose X_frame_zero = joint_pose(joint, at_zero);
  Mat3 before = Mat3::Identity();  // rotations of the joint that come before the one that moves
  for (const Axis& axis : joint.rotations) {
    if (axis.coordinate == moving.angle) {
      const double sign = axis.function.scale * axis.function.coefficients[0] < 0 ? -1 : 1;
      moving.axis = X_parent_frame.R * before * (sign * axis.direction);
      break;
    }
    before = before * exp_rotation(value_of(axis, at_zero) * axis.direction);
  }
  const Pose X_parent_zero = X_parent_frame * X_frame_zero;
  moving.origin = X_parent_zero.p;
  const Pose X_child_rigid = X_parent_zero.inverse() * Pose{Mat3::Identity(), moving.origin};
  X_ground_rigid[at(moving.child)] = X_ground_child * X_child_rigid;
  return true;
}

bool Skeleton::frame_rigid_bodies(Diagnostics& out) {
  std::vector<bool> framed(bodies_.size(), false);
  std::vector<Pose> X_ground_rigid(bodies_.size());
  for (const int j : order_)
    for (MovingJoint& moving : joints_)
      if (moving.joint == j && !frame_joint(moving, framed, X_ground_rigid, out)) return false;
  in_rigid_.assign(in_ground_.size(), {});
  for (std::size_t b = 0; b < in_ground_.size(); ++b)
    in_rigid_[b] = X_ground_rigid[at(rigid_of_[b])].inverse() * in_ground_[b];
  return true;
}

void Skeleton::add_masses() {
  for (RigidBody& rigid : bodies_) {
    const auto each = [&](const auto& f) {
      for (const int b : rigid.bodies)
        if (at(b) < model_->bodies.size()) f(model_->bodies[at(b)], in_rigid(b));
    };
    each([&](const Body& b, const Pose& X) {
      rigid.mass += b.mass;
      rigid.centre += b.mass * (X * b.centre);
    });
    if (rigid.mass > 0) rigid.centre /= rigid.mass;
    each([&](const Body& b, const Pose& X) {  // Steiner
      const Vec3 d = X * b.centre - rigid.centre;
      rigid.inertia += X.R * b.inertia * X.R.transpose() - b.mass * skew(d) * skew(d);
    });
  }
}

std::optional<Skeleton> Skeleton::build(const Model& model, const std::vector<std::string>& joints,
                                        const CoordinateValues& values, Diagnostics& out) {
  Skeleton s(model);
  if (!s.link_joints(out) || !s.choose_joints(joints, out)) return std::nullopt;
  s.settle_values(values);
  if (!s.place_bodies(out)) return std::nullopt;
  s.unite_bodies();
  if (!s.frame_rigid_bodies(out)) return std::nullopt;
  s.add_masses();
  return s;
}

}  // namespace genu::osim
