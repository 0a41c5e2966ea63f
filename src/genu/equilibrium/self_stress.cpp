#include "genu/equilibrium/self_stress.h"

#include <algorithm>
#include <cmath>

#include "genu/core/decompositions.h"
#include "genu/equilibrium/feasible_direction.h"
#include "genu/equilibrium/pose_accuracy.h"
#include "genu/equilibrium/tolerances.h"
#include "genu/model/ligament_pieces.h"

namespace genu {
namespace {

std::vector<Candidate> nearest(std::vector<Candidate> touching) {
  std::stable_sort(touching.begin(), touching.end(),
                   [](const Candidate& x, const Candidate& y) { return x.minimum.gap < y.minimum.gap; });
  if (touching.size() > kMaxTouchingPlaces) touching.resize(kMaxTouchingPlaces);
  return touching;
}

/// How a force may change in a self-stress, when it is at an end of its range.
enum class May { anything, grow, fall };

/// Rows of `self_stresses` that may not decrease, or not increase, as bounds.
class Bounds {
 public:
  explicit Bounds(const MatX& self_stresses) : self_stresses_(self_stresses), rows_(0, self_stresses.cols()) {}

  void add(Eigen::Index row, May may) {
    if (may == May::anything || self_stresses_.row(row).norm() < kIdleShare) return;
    rows_.conservativeResize(rows_.rows() + 1, Eigen::NoChange);
    rows_.bottomRows<1>() = (may == May::grow ? -1 : 1) * self_stresses_.row(row);
  }
  const MatX& rows() const { return rows_; }

 private:
  const MatX& self_stresses_;
  MatX rows_;
};

May of_held(const JointModel& model, const LigamentPiece& p, double no_force) {
  const LawBreak& b = model.ligaments[at(p.ligament)].law.sharp_breaks()[at(p.piece)];
  const auto [low, high] = std::minmax(b.below.force, b.above.force);
  return p.force <= low + no_force ? May::grow : p.force >= high - no_force ? May::fall : May::anything;
}

/// Contacts without force may not pull. Ligaments held at an end of a jump may not leave it.
MatX bounds_of(const JointModel& model, const Target& target, const MatX& self_stresses, const State& state) {
  const double no_force = kPullTolerance * model.scales.force;
  Bounds out(self_stresses);
  auto row = static_cast<Eigen::Index>(constraint_count(model, target));
  for (const LigamentPiece& p : state.pieces)
    if (p.held) out.add(row++, of_held(model, p, no_force));
  for (const ActiveContact& c : state.contacts)
    out.add(row++, std::abs(c.force) > no_force ? May::anything : May::grow);
  return out.rows();
}

/// Whether a ligament may be at a jump of its force; needs no equations.
bool may_jump(const JointModel& model, const State& state, const Target& target, double residual) {
  const auto jumps_up = [](const LawBreak& b) { return b.force_jump() > 0; };
  const bool some = std::any_of(model.ligaments.begin(), model.ligaments.end(), [&](const auto& l) {
    const auto& breaks = l.law.sharp_breaks();
    return std::any_of(breaks.begin(), breaks.end(), jumps_up);
  });
  if (!some) return false;
  const auto points = nonsmooth_points_near(model, state, target, PoseAccuracy::widest_reach(model, residual));
  return std::any_of(points.begin(), points.end(), [](const NonsmoothPoint& k) { return k.jump > 0; });
}

/// The motions that prescribed and held coordinates leave, in the metric of stability.
MatX left_by_constraints(const Linearization& at, Eigen::Index constraints) {
  MatX rows = at.gradient.topRows(constraints) * stability_metric(at.wrench.size()).asDiagonal();
  rows.rowwise().normalize();
  return null_space(rows, kDependentRow);
}

/// Ligaments at a length where their force jumps up become held there: any force between could balance too. Where the
/// length is prescribed, the law determines the force, on the side that the path comes from.
void hold_at_jumps(const JointModel& model, const Target& target, const Linearization& at_pose,
                   const PoseAccuracy& accuracy, State& state) {
  const MatX left = left_by_constraints(at_pose, static_cast<Eigen::Index>(constraint_count(model, target)));
  for (const NonsmoothPoint& k : nonsmooth_points_near(model, state, target, accuracy.reach())) {
    const VecX longer = stability_metric(k.gradient.size()).cwiseProduct(k.gradient);
    if (!(k.jump > 0) || (left.transpose() * longer).norm() <= accuracy.of_rows() * longer.norm()) continue;
    const auto piece = std::find_if(state.pieces.begin(), state.pieces.end(),
                                    [&](const LigamentPiece& p) { return p.ligament == k.ligament; });
    if (piece == state.pieces.end()) continue;
    const LawBreak& b = model.ligaments[at(k.ligament)].law.sharp_breaks()[at(k.law_break)];
    piece->force = k.beyond ? b.above.force : b.below.force;
    piece->piece = k.law_break;
    piece->held = true;
  }
}

/// The rows of `self_stresses` that can take part in one that satisfies `bounds`.
std::vector<int> possible(const MatX& self_stresses, const MatX& bounds) {
  if (self_stresses.cols() == 0) return {};
  MatX ways = null_space(bounds, kDependentRow);
  ways.conservativeResize(Eigen::NoChange, ways.cols() + 1);
  ways.rightCols<1>() = feasible_direction(bounds, MatX::Identity(self_stresses.cols(), self_stresses.cols()));
  return taking_part(self_stresses * ways);
}

}  // namespace

void find_self_stress(ActiveSetSolver& solver, const Target& target, const Certificate& certificate, Balanced& pose,
                      Stability& stability) {
  const JointModel& model = solver.model();
  const bool touching = certificate.touching > 0, unsolved = certificate.residual > solver.tolerance();
  if (!touching && !unsolved && stability.redundant.empty() &&
      !may_jump(model, pose.state, target, certificate.residual))
    return;
  Linearization at;
  at.layers = solver.newton().linearization().layers;  // they know this pose
  linearize(model, pose.state, target, at);
  const PoseAccuracy accuracy(model, target, at);
  Balanced closed = pose;
  hold_at_jumps(model, target, at, accuracy, closed.state);
  if (touching)
    for (const Candidate& c : nearest(solver.touching(pose.state))) solver.close(closed, c);
  linearize(model, closed.state, target, at);
  const MatX stresses = self_stresses(at, model.scales.length, accuracy.of_rows());
  stability.redundant = possible(stresses, bounds_of(model, target, stresses, closed.state));
  if (!stability.redundant.empty()) pose = std::move(closed);
}

}  // namespace genu
