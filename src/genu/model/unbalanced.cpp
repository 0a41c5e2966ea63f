#include "genu/model/unbalanced.h"

#include "genu/core/decompositions.h"
#include "genu/model/layer_levels.h"

namespace genu {
namespace {

/// Every moving body is the child of one joint, so there are as many coordinates as equations.
std::optional<std::vector<JointValues>> on_coordinates(const JointModel& model, const State& state,
                                                       const VecX& missing) {
  MatX gradients = MatX::Zero(missing.size(), 6 * static_cast<Eigen::Index>(model.joints.size()));
  for (int j = 0; j < static_cast<int>(model.joints.size()); ++j) {
    const auto& joint = model.joints[at(j)];
    const JointPoint point = joint_point(model, state, j);
    if (point.at_gimbal()) return std::nullopt;
    const int parent = model.bodies[at(joint.parent)].moving, child = model.bodies[at(joint.child)].moving;
    for (int i = 0; i < 6; ++i) {
      const JointPoint::Gradient gradient = point.gradient(i);
      if (parent >= 0) gradients.col(6 * j + i).segment<6>(6 * parent) += gradient.head<6>().transpose();
      if (child >= 0) gradients.col(6 * j + i).segment<6>(6 * child) += gradient.tail<6>().transpose();
    }
  }
  const VecX solved = least_squares_solution(gradients, missing);
  std::vector<JointValues> forces(model.joints.size());
  for (std::size_t j = 0; j < forces.size(); ++j)
    for (std::size_t i = 0; i < 6; ++i) forces[j][i] = solved[static_cast<Eigen::Index>(6 * j + i)];
  return forces;
}

}  // namespace

Unbalanced unbalanced(const JointModel& model, State state, Target target, Linearization& memory) {
  target.prescribed.clear();
  state.contacts.clear();
  state.multipliers.assign(model.held.size(), 0.0);
  do {
    linearize(model, state, target, memory);
  } while (raise_layer_levels(model, memory, state));
  Unbalanced out;
  out.layer_levels = state.layer_levels;
  out.wrenches.resize(at(model.moving_count));
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const int moving = model.bodies[b].moving;
    if (moving < 0) continue;
    const Mat3 to_body = state.poses[b].R.transpose();
    Vec6& wrench = out.wrenches[at(moving)];
    wrench.head<3>() = -(to_body * memory.wrench.segment<3>(6 * moving));
    wrench.tail<3>() = -(to_body * memory.wrench.segment<3>(6 * moving + 3)) -
                       own_origin(model, static_cast<int>(b)).cross(Vec3(wrench.head<3>()));
  }
  out.forces = on_coordinates(model, state, -memory.wrench);
  return out;
}

}  // namespace genu
