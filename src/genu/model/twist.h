// Twists of single bodies and joints from the twists of all moving bodies (6 each).
#pragma once

#include "genu/model/joint_model.h"

namespace genu {

/// The twist of a body of the model; 0 for a fixed one, and where `body` is -1.
inline Vec6 twist_of_body(const JointModel& model, int body, const VecX& twist) {
  const int k = body < 0 ? -1 : model.bodies[static_cast<std::size_t>(body)].moving;
  return k < 0 ? Vec6(Vec6::Zero()) : Vec6(twist.segment<6>(6 * k));
}

/// [twist of the parent; twist of the child]; 0 for a fixed body.
inline Vec12 twist_of_pair(const JointModel& model, int joint, const VecX& twist) {
  Vec12 out = Vec12::Zero();
  const auto& j = model.joints[static_cast<std::size_t>(joint)];
  const int parent = model.bodies[static_cast<std::size_t>(j.parent)].moving;
  const int child = model.bodies[static_cast<std::size_t>(j.child)].moving;
  if (parent >= 0) out.head<6>() = twist.segment<6>(6 * parent);
  if (child >= 0) out.tail<6>() = twist.segment<6>(6 * child);
  return out;
}

/// Adds a wrench on parent and child to the wrenches of all moving bodies.
inline void add_to_pair(const JointModel& model, int joint, const Vec12& wrench, VecX& out) {
  const auto& j = model.joints[static_cast<std::size_t>(joint)];
  const int parent = model.bodies[static_cast<std::size_t>(j.parent)].moving;
  const int child = model.bodies[static_cast<std::size_t>(j.child)].moving;
  if (parent >= 0) out.segment<6>(6 * parent) += wrench.head<6>();
  if (child >= 0) out.segment<6>(6 * child) += wrench.tail<6>();
}

}  // namespace genu
