#include "genu/motion/hinge_tree.h"

namespace genu {
namespace {

/// Number of held coordinates of a joint, and whether its first angle is held.
struct Holding {
  int count = 0;
  bool angle = false;
};

Holding holding(const JointModel& model, int joint) {
  Holding out;
  for (const auto& held : model.held) {
    if (held.coordinate.joint != joint) continue;
    ++out.count;
    out.angle = out.angle || held.coordinate.index == 0;
  }
  return out;
}

}  // namespace

bool HingeTree::describes(const JointModel& model) {
  for (int j = 0; j < static_cast<int>(model.joints.size()); ++j) {
    const Holding h = holding(model, j);
    if (h.count < 5 || (h.count == 5 && h.angle)) return false;
  }
  return !model.joints.empty();
}

HingeTree::HingeTree(const JointModel& model) : model_(model), hinge_of_joint_(model.joints.size(), -1) {
  const std::size_t bodies = model.bodies.size();
  std::vector<std::vector<int>> hinges_of(bodies);
  std::vector<bool> placed(bodies);
  for (std::size_t i = 0; i < bodies; ++i) placed[i] = model.bodies[i].moving < 0;
  for (bool more = true; more;) {
    more = false;
    for (int j = 0; j < static_cast<int>(model.joints.size()); ++j) {
      const auto& joint = model.joints[at(j)];
      if (!placed[at(joint.parent)] || placed[at(joint.child)]) continue;
      Link link{j, joint.parent, joint.child, -1, hinges_of[at(joint.parent)], Mat3::Identity(), {}};
      for (const auto& held : model.held)
        if (held.coordinate.joint == j) link.values[at(held.coordinate.index)] = held.value;
      link.held = joint.coordinates.rotation_after_first(link.values);
      if (holding(model, j).count == 5) {
        link.hinge = hinge_of_joint_[at(j)] = static_cast<int>(hinges_.size());
        link.hinges.push_back(link.hinge);
        hinges_.push_back({j});
      }
      hinges_of[at(joint.child)] = link.hinges;
      links_.push_back(std::move(link));
      placed[at(joint.child)] = more = true;
    }
  }
  bodies_.resize(bodies);
  moved_.resize(hinges_.size());
  turned_.resize(hinges_.size());
  mass_.resize(count(), count());
  force_.resize(count());
}

void HingeTree::place(const Link& link, const VecX& angles, const VecX& rates, State& state) {
  const JointCoordinates& joint = model_.joints[at(link.joint)].coordinates;
  const Pose& X_P = state.poses[at(link.parent)];
  const Rates& parent = bodies_[at(link.parent)];
  JointValues& values = state.coordinates[at(link.joint)];
  values = link.values;
  double rate = 0;
  if (link.hinge >= 0) {
    values[0] = angles[link.hinge];
    rate = rates[link.hinge];
  }
  const Mat3 R_PC = joint.rotation_about_first(values[0]) * link.held;
  const Vec3 own(values[3], values[4], values[5]);
  Pose& X_C = state.poses[at(link.child)];
  X_C = X_P * Pose{R_PC, own + R_PC * joint.child_centre() - joint.parent_centre()};
  // The child's own origin is fixed in the parent, and the child rotates about it.
  const Vec3 axis = X_P.R * joint.first_axis(), hinge = X_P * Vec3(own - joint.parent_centre());
  if (link.hinge >= 0) {
    hinges_[at(link.hinge)].axis = axis;
    hinges_[at(link.hinge)].point = hinge;
  }
  Rates& child = bodies_[at(link.child)];
  const Vec3 to_hinge = hinge - X_P.p, from_hinge = X_C.p - hinge;
  child.w = parent.w + rate * axis;
  child.turning = parent.turning + rate * parent.w.cross(axis);
  child.v = parent.v + parent.w.cross(to_hinge) + child.w.cross(from_hinge);
  child.a = parent.a + parent.turning.cross(to_hinge) + parent.w.cross(parent.w.cross(to_hinge)) +
            child.turning.cross(from_hinge) + child.w.cross(child.w.cross(from_hinge));
}

void HingeTree::place(const VecX& angles, const VecX& rates, State& state, VecX& twist) {
  twist.resize(6 * model_.moving_count);
  for (const Link& link : links_) {
    place(link, angles, rates, state);
    const Rates& child = bodies_[at(link.child)];
    twist.segment<6>(6 * model_.bodies[at(link.child)].moving) << child.v, child.w;
  }
}

/// Adds the mass and force of one body.
void HingeTree::add(const Link& link, const Pose& X, const Vec6& wrench) {
  const Inertia& inertia = model_.inertias[at(model_.bodies[at(link.child)].moving)];
  const Rates& rates = bodies_[at(link.child)];
  const Vec3 arm = X.R * inertia.centre_of_mass, centre = X.p + arm;
  const Mat3 about = X.R * inertia.about_centre_of_mass * X.R.transpose();
  const Vec3 drift = rates.a + rates.turning.cross(arm) + rates.w.cross(rates.w.cross(arm));
  const Vec3 force = wrench.head<3>() - inertia.mass * drift;
  const Vec3 moment =
      wrench.tail<3>() - arm.cross(wrench.head<3>()) - about * rates.turning - rates.w.cross(about * rates.w);
  for (std::size_t n = 0; n < link.hinges.size(); ++n) {
    const int j = link.hinges[n];
    const Hinge& hinge = hinges_[at(j)];
    moved_[n] = hinge.axis.cross(centre - hinge.point);
    turned_[n] = about * hinge.axis;
    force_[j] += moved_[n].dot(force) + hinge.axis.dot(moment);
    for (std::size_t l = 0; l <= n; ++l)  // hinges are numbered from the ground: lower triangle
      mass_(j, link.hinges[l]) += inertia.mass * moved_[n].dot(moved_[l]) + hinge.axis.dot(turned_[l]);
  }
}

bool HingeTree::accelerate(const State& state, const VecX& wrench, const VecX& moments, VecX& accelerations) {
  mass_.setZero();
  force_ = moments;
  for (const Link& link : links_)
    if (!link.hinges.empty())
      add(link, state.poses[at(link.child)], wrench.segment<6>(6 * model_.bodies[at(link.child)].moving));
  factor_.compute(mass_);
  if (factor_.info() != Eigen::Success) return false;
  accelerations = factor_.solve(force_);
  return accelerations.allFinite();
}

}  // namespace genu
