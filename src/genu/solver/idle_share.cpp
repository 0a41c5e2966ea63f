#include "genu/solver/idle_share.h"

#include <algorithm>
#include <cmath>

#include "genu/core/decompositions.h"
#include "genu/solver/way_out.h"

namespace genu {
namespace {

constexpr double kRounding = 1e-9;  // of a trade, whose norm is 1: what takes part by less takes none
constexpr std::size_t kMost = 60;   // touching places looked at, those with the smallest gap

std::vector<Candidate> nearest(std::vector<Candidate> touching) {
  std::stable_sort(touching.begin(), touching.end(),
                   [](const Candidate& x, const Candidate& y) { return x.minimum.gap < y.minimum.gap; });
  if (touching.size() > kMost) touching.resize(kMost);
  return touching;
}

/// The rows of `trades` that belong to contacts without force, as bounds: none of these may press less.
MatX no_less(const MatX& trades, const State& state, double no_force) {
  const auto first = trades.rows() - static_cast<Eigen::Index>(state.contacts.size());
  MatX out(0, trades.cols());
  for (std::size_t c = 0; c < state.contacts.size(); ++c) {
    const auto row = trades.row(first + static_cast<Eigen::Index>(c));
    if (std::abs(state.contacts[c].force) > no_force || row.norm() < kRounding) continue;
    out.conservativeResize(out.rows() + 1, Eigen::NoChange);
    out.bottomRows<1>() = -row;
  }
  return out;
}

/// The rows of `trades` that can take part in one, where what `bounds` says holds.
std::vector<int> possible(const MatX& trades, const MatX& bounds) {
  MatX ways = null_space(bounds, kDependentRow);
  ways.conservativeResize(Eigen::NoChange, ways.cols() + 1);
  ways.rightCols<1>() = way_out(bounds, MatX::Identity(trades.cols(), trades.cols()));
  return trading(trades * ways);
}

}  // namespace

void share_with_idle(ContactSetSolver& solver, const Target& target, bool touching, Balanced& pose,
                     Stability& stability) {
  if (!touching && stability.redundant.empty()) return;
  Balanced closed = pose;
  if (touching)
    for (const Candidate& c : nearest(solver.touching(pose.state))) solver.close(closed, c);
  const JointModel& model = solver.model();
  Linearization at;
  linearize(model, closed.state, target, at);
  const MatX trades = force_trades(at, model.scales.length);
  const double no_force = ContactInspector::kForceTolerance * model.scales.force;
  stability.redundant = possible(trades, no_less(trades, closed.state, no_force));
  if (!stability.redundant.empty()) pose = std::move(closed);
}

}  // namespace genu
