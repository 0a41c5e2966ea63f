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

bool any_at_gimbal(const JointModel& model, const State& state) {
  for (int j = 0; j < static_cast<int>(model.joints.size()); ++j)
    if (joint_point(model, state, j).at_gimbal()) return true;
  return false;
}

}  // namespace

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
  if (any_at_gimbal(model, state)) return std::nullopt;
  Target target;
  target.load_factors = load_factors;
  target.time = time;
  for (std::size_t k = 0; k < free.size(); ++k) target.prescribed.push_back({free[k], values[k]});
  // Every moving body is the child of one joint: as many coordinates, free and held, as equations.
  state.multipliers.assign(constraint_count(model, target), 0.0);
  do {
    linearize(model, state, target, memory);
  } while (raise_layer_levels(model, memory, state));
  const MatX gradients = memory.gradient.topRows(static_cast<Eigen::Index>(state.multipliers.size()));
  const VecX forces = least_squares_solution(gradients.transpose(), memory.wrench);
  for (std::size_t m = 0; m < state.multipliers.size(); ++m)
    state.multipliers[m] = -forces[static_cast<Eigen::Index>(m)];
  linearize(model, state, target, memory);
  const MatX by_twists = least_squares_solution(gradients.transpose(), memory.stiffness);
  const MatX by_values = least_squares_solution(gradients.transpose(), by_twists.transpose()).transpose();
  const auto n = static_cast<Eigen::Index>(free.size());
  return GeneralisedForces{forces.head(n), by_values.topLeftCorner(n, n)};
}

}  // namespace genu
