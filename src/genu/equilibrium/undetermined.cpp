#include "genu/equilibrium/undetermined.h"

#include <algorithm>
#include <cmath>

#include "genu/equilibrium/tolerances.h"

namespace genu {
namespace {

/// Change of each coordinate along `mode`, which is in the metric of Stability.
std::vector<std::pair<CoordinateRef, double>> changes_along(const JointModel& model, const State& state,
                                                            const VecX& mode) {
  std::vector<std::pair<CoordinateRef, double>> out;
  for (int j = 0; j < static_cast<int>(model.joints.size()); ++j) {
    const auto& joint = model.joints[at(j)];
    const JointPoint point = joint.coordinates.evaluate(state.poses[at(joint.parent)], state.poses[at(joint.child)],
                                                        state.coordinates[at(j)]);
    Vec12 twist = Vec12::Zero();
    const int bodies[2] = {model.bodies[at(joint.parent)].moving, model.bodies[at(joint.child)].moving};
    for (int k = 0; k < 2; ++k) {
      if (bodies[k] < 0) continue;
      twist.segment<6>(6 * k) = mode.segment<6>(6 * bodies[k]);
      twist.segment<3>(6 * k) *= kMetricLength;
    }
    for (int i = 0; i < 6; ++i)
      out.push_back({{j, i}, std::abs(point.gradient(i).dot(twist)) / (i < 3 ? 1 : kMetricLength)});
  }
  return out;
}

}  // namespace

Undetermined find_undetermined(const JointModel& model, const State& state, const Target& target,
                               const Stability& stability) {
  Undetermined out;
  const int prescribed = static_cast<int>(target.prescribed.size());
  const int constraints = static_cast<int>(constraint_count(model, target));
  std::vector<int> held;
  for (const LigamentPiece& p : state.pieces)
    if (p.held) held.push_back(p.ligament);
  for (const int row : stability.redundant) {
    if (row < prescribed)
      out.shared_reactions.push_back(target.prescribed[at(row)].coordinate);
    else if (row < constraints)
      out.shared_reactions.push_back(model.held[at(row - prescribed)].coordinate);
    else if (row < constraints + static_cast<int>(held.size()))
      out.shared_ligaments.push_back(held[at(row - constraints)]);
    else
      out.shared_contacts.push_back(row - constraints - static_cast<int>(held.size()));
  }
  std::vector<std::pair<CoordinateRef, bool>> named;
  for (Eigen::Index mode = 0; mode < stability.neutral.cols(); ++mode) {
    const auto changes = changes_along(model, state, stability.neutral.col(mode));
    double largest = 0;
    for (const auto& [coordinate, change] : changes) largest = std::max(largest, change);
    named.resize(changes.size());
    for (std::size_t i = 0; i < changes.size(); ++i)
      named[i] = {changes[i].first, named[i].second || changes[i].second > kNamedShare * largest};
  }
  for (const auto& [coordinate, is_free] : named)
    if (is_free) out.free_motion.push_back(coordinate);
  return out;
}

}  // namespace genu
