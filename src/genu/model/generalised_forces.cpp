#include "genu/model/generalised_forces.h"

#include <algorithm>

#include "genu/core/decompositions.h"
#include "genu/model/layer_levels.h"
#include "genu/model/ligament_pieces.h"

namespace genu {
namespace {

State state_at(const JointModel& model, const std::vector<CoordinateRef>& free, const std::vector<double>& values) {
  State state = reference_state(model);
  for (std::size_t k = 0; k < free.size(); ++k) state.coordinates[at(free[k].joint)][at(free[k].index)] = values[k];
  state.poses = poses_from_coordinates(model, state.coordinates);
  reset_pieces(model, state);
  return state;
}

}  // namespace

std::optional<MatX> on_coordinates(const JointModel& model, const State& state, const MatX& wrenches) {
  MatX gradients = MatX::Zero(wrenches.rows(), 6 * static_cast<Eigen::Index>(model.joints.size()));
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
  return least_squares_solution(gradients, wrenches);
}

std::vector<CoordinateRef> free_coordinates(const JointModel& model) {
  std::vector<CoordinateRef> free;
  for (int j = 0; j < static_cast<int>(model.joints.size()); ++j)
    for (int i = 0; i < 6; ++i) {
      const CoordinateRef c{j, i};
      if (std::none_of(model.held.begin(), model.held.end(), [&](const auto& h) { return h.coordinate == c; }))
        free.push_back(c);
    }
  return free;
}

std::optional<GeneralisedForces> generalised_forces(const JointModel& model, const std::vector<double>& values,
                                                    const std::vector<double>& load_factors, double time,
                                                    Linearization& memory) {
  const std::vector<CoordinateRef> free = free_coordinates(model);
  State state = state_at(model, free, values);
  Target target;
  target.load_factors = load_factors;
  target.time = time;
  for (std::size_t k = 0; k < free.size(); ++k) target.prescribed.push_back({free[k], values[k]});
  state.multipliers.assign(constraint_count(model, target), 0.0);
  do {
    linearize(model, state, target, memory);
  } while (raise_layer_levels(model, memory, state));
  const auto row = [](const CoordinateRef& q) { return static_cast<Eigen::Index>(6 * q.joint + q.index); };
  const auto forces = on_coordinates(model, state, memory.wrench);
  if (!forces) return std::nullopt;
  for (std::size_t m = 0; m < state.multipliers.size(); ++m)
    state.multipliers[m] = -(*forces)(row(m < free.size() ? free[m] : model.held[m - free.size()].coordinate), 0);
  linearize(model, state, target, memory);
  const MatX by_twists = *on_coordinates(model, state, memory.stiffness);
  const MatX by_values = *on_coordinates(model, state, by_twists.transpose());
  const auto n = static_cast<Eigen::Index>(free.size());
  GeneralisedForces out{VecX(n), MatX(n, n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    out.forces[i] = (*forces)(row(free[static_cast<std::size_t>(i)]), 0);
    for (Eigen::Index j = 0; j < n; ++j)
      out.derivatives(i, j) = by_values(row(free[static_cast<std::size_t>(j)]), row(free[static_cast<std::size_t>(i)]));
  }
  return out;
}

}  // namespace genu
