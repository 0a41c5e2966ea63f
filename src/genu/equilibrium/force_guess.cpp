#include "genu/equilibrium/force_guess.h"

#include <algorithm>

#include "genu/core/decompositions.h"
#include "genu/equilibrium/moving_blocks.h"

namespace genu {

bool guess_forces(const JointModel& model, const Target& target, State& state) {
  if (state.contacts.empty()) return false;
  for (ActiveContact& c : state.contacts) c.force = 0;
  fit_multipliers(model, target, state);
  std::fill(state.multipliers.begin(), state.multipliers.end(), 0.0);
  Linearization here;
  linearize(model, state, target, here);
  const Eigen::Index n = here.wrench.size();
  const auto m = static_cast<Eigen::Index>(state.multipliers.size());
  const auto contacts = static_cast<Eigen::Index>(state.contacts.size());
  MatX columns = MatX::Zero(n, m + contacts);
  columns.leftCols(m) = here.gradient.topRows(m).transpose();
  for (const auto& column : here.load_columns) columns.col(column.row) = column.wrench;
  for (Eigen::Index c = 0; c < contacts; ++c) {
    const auto k = static_cast<std::size_t>(c);
    for_moving(here.contact_bodies[k],
               [&](int from, int to) { columns.block<6, 1>(to, m + c) = here.contacts[k].direction.segment<6>(from); });
  }
  VecX scale(n);
  for (Eigen::Index i = 0; i < n; ++i) scale[i] = i % 6 < 3 ? 1 : 1 / model.scales.length;
  const MatX found = least_squares_solution(scale.asDiagonal() * columns, scale.asDiagonal() * (-here.wrench));
  if (!found.allFinite()) return false;
  for (Eigen::Index k = 0; k < m; ++k) state.multipliers[static_cast<std::size_t>(k)] = found(k, 0);
  bool presses = false;
  for (Eigen::Index c = 0; c < contacts; ++c) {
    double& force = state.contacts[static_cast<std::size_t>(c)].force;
    force = std::max(0.0, found(m + c, 0));
    presses = presses || force > 0;
  }
  return presses;
}

}  // namespace genu
