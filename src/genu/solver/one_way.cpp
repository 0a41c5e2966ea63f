#include "genu/solver/one_way.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "genu/contact/elastic_layer.h"
#include "genu/model/kinks.h"
#include "genu/model/ligament_pieces.h"
#include "genu/solver/moving_blocks.h"
#include "genu/solver/newton_step.h"
#include "genu/solver/one_sided.h"

namespace genu {
namespace {

constexpr double kHardly = 3e-8;   // of the force scale: what presses or pulls by more is not idle at any pose
constexpr double kNear = 1e-6;     // of the length scale, rad: what is farther from a kink is on its side at any pose
constexpr double kSolved = 2e-12;  // the same, at every pose: lengths are known to this by what Newton's method accepts

bool idle_held(const JointModel& model, const LigamentPiece& p, double force) {
  if (!p.held) return false;
  const LawBreak& b = model.ligaments[at(p.ligament)].ligament.law.sharp_breaks()[at(p.piece)];
  return std::min(std::abs(p.force - b.below.force), std::abs(p.force - b.above.force)) <= force;
}

/// Whether there is anything to let go, told without the equations.
bool may_be_idle(const JointModel& model, const State& state, const Target& target,
                 const std::vector<double>& layer_loads) {
  const double hardly = kHardly * model.scales.force;
  const auto idle = [hardly](double load) { return load <= hardly; };
  return std::any_of(layer_loads.begin(), layer_loads.end(), idle) ||
         std::any_of(state.contacts.begin(), state.contacts.end(),
                     [&](const ActiveContact& c) { return idle(std::abs(c.force)); }) ||
         std::any_of(state.pieces.begin(), state.pieces.end(),
                     [&](const LigamentPiece& p) { return idle_held(model, p, hardly); }) ||
         !kinks_near(model, state, target, kNear, hardly).empty();
}

/// How far the pose may be from the one that is meant.
struct Accuracy {
  double force = 0;  ///< N: what presses or pulls with no more may not
  VecX twist;        ///< 6B: what Newton's method would still correct; 0 where it cannot tell
};

Accuracy accuracy_of(const JointModel& model, const Target& target, const Linearization& at) {
  constexpr double kRounding = 1e-15;
  double unbalanced = 0;
  for (Eigen::Index i = 0; i < at.wrench.size(); ++i)
    unbalanced = std::max(unbalanced, std::abs(at.wrench[i]) / (i % 6 < 3 ? 1 : model.scales.length));
  Accuracy out{2 * unbalanced + kRounding * model.scales.force, VecX::Zero(at.wrench.size())};
  NewtonStep step(model);
  Correction correction;
  if (step.factor(at, target) && step.linear().full_rank()) {
    step.solve(at, correction);
    if (correction.twist.allFinite()) out.twist = correction.twist;
  }
  return out;
}

/// A plane of motions: of a closed one, `gradient` is how fast a twist (6B) goes beyond it.
struct Plane {
  VecX gradient, wrench = {};   ///< of twists, 6B
  double below = 0, above = 0;  ///< slopes, as of a Kink
  bool closed = false;
};

/// The pose without what is idle and without what jumps, and that.
struct Released {
  Linearization at;
  std::vector<Plane> planes;
  double cancelled = 0;  ///< J: the size of what was taken out of the stiffness, in the metric
};

/// Moves what holds closed and carries no more than `force` out of `state`: contacts, ligaments held at a jump.
bool release_closed(const JointModel& model, const Linearization& at_pose, double force, State& state,
                    std::vector<Plane>& planes) {
  const auto n = at_pose.wrench.size();
  std::vector<ActiveContact> kept;
  bool any = false;
  for (std::size_t c = 0; c < state.contacts.size(); ++c) {
    if (std::abs(state.contacts[c].force) > force) {
      kept.push_back(state.contacts[c]);
      continue;
    }
    VecX closing = VecX::Zero(n);
    for (int side = 0; side < 2; ++side)
      if (const int body = at_pose.contact_bodies[c][at(side)]; body >= 0)
        closing.segment<6>(6 * body) -= at_pose.contacts[c].direction.segment<6>(6 * side);
    planes.push_back({.gradient = closing, .closed = true});
    any = true;
  }
  state.contacts = std::move(kept);
  for (LigamentPiece& p : state.pieces) {
    if (!idle_held(model, p, force)) continue;
    const auto& l = model.ligaments[at(p.ligament)];
    const LawBreak& b = l.ligament.law.sharp_breaks()[at(p.piece)];
    const bool above = std::abs(p.force - b.above.force) < std::abs(p.force - b.below.force);
    const VecX longer = ligament_length_gradient(model, l, state.poses);
    planes.push_back({.gradient = above ? VecX(-longer) : longer, .closed = true});
    p.held = false;
    p.piece += above;
    any = true;
  }
  return any;
}

/// Takes out of the stiffness what jumps where the pose cannot be told from the kink.
bool release_kinks(const JointModel& model, const State& state, const Target& target, const Accuracy& accuracy,
                   Released& out) {
  constexpr double kTimes = 10;  // the correction that is left, which is an estimate
  const VecX unit = stability_metric(out.at.wrench.size());
  bool any = false;
  for (Kink& k : kinks_near(model, state, target, kNear, kHardly * model.scales.force)) {
    const double reach = kSolved * k.unit + kTimes * std::abs(k.gradient.dot(accuracy.twist));
    const bool idle = k.force != 0 && std::abs(k.force) <= accuracy.force;
    if (!idle && std::abs(k.past) > reach) continue;
    any = any || k.here != 0 || k.below != k.above;
    out.cancelled += std::max({std::abs(k.here), std::abs(k.below), std::abs(k.above)}) *
                     k.gradient.cwiseProduct(unit).norm() * k.wrench.cwiseProduct(unit).norm();
    const double base = k.below == k.above ? k.below : 0;
    out.at.stiffness += (base - k.here) * k.wrench * k.gradient.transpose();
    if (k.below != k.above) out.planes.push_back({std::move(k.gradient), std::move(k.wrench), k.below, k.above, false});
  }
  return any;
}

/// Layers begin to press as softly as a toe to pull.
bool release_layers(const JointModel& model, const State& state, double force, Linearization& at_pose) {
  bool any = false;
  LayerWrench pressed;
  for (std::size_t k = 0; k < model.layers.size(); ++k) {
    if (at_pose.layer_loads[k] <= 0 || at_pose.layer_loads[k] > force) continue;
    any = true;
    const auto& layer = model.layers[k];
    layer.layer->evaluate(state.poses[at(layer.body_a)], state.poses[at(layer.body_b)], at_pose.layers->each[k],
                          pressed, state.layer_level(k), nullptr);
    const std::array<int, 2> bodies = {model.bodies[at(layer.body_a)].moving, model.bodies[at(layer.body_b)].moving};
    for_moving(bodies, [&](int from, int to) {
      for_moving(bodies, [&](int from2, int to2) {
        at_pose.stiffness.block<6, 6>(to, to2) -= pressed.stiffness.block<6, 6>(from, from2);
      });
    });
  }
  return any;
}

/// False where there is nothing to let go.
bool release(const JointModel& model, const State& state, const Target& target, Released& out) {
  linearize(model, state, target, out.at);
  const Accuracy accuracy = accuracy_of(model, target, out.at);
  State loose = state;
  bool any = release_closed(model, out.at, accuracy.force, loose, out.planes);
  if (any) linearize(model, loose, target, out.at);
  any = release_layers(model, state, accuracy.force, out.at) || any;
  return release_kinks(model, state, target, accuracy, out) || any;
}

/// Among the motions that are free.
OneSidedStiffness among(const FreeStiffness& free, const std::vector<Plane>& planes) {
  const MatX& basis = free.basis;
  OneSidedStiffness out{basis.transpose() * free.stiffness * basis, {}, free.known_to};
  const VecX unit = stability_metric(basis.rows());
  for (const Plane& plane : planes) {
    const VecX gradient = unit.cwiseProduct(plane.gradient), row = basis.transpose() * gradient;
    if (!(row.norm() > kDependentRow * gradient.norm())) continue;  // nothing moves across
    Side side{row.normalized(), VecX::Zero(row.size()), VecX::Zero(row.size()), plane.closed};
    if (!plane.closed) {
      const VecX push = -row.norm() * (basis.transpose() * unit.cwiseProduct(plane.wrench));
      side.below = plane.below * push;
      side.above = plane.above * push;
    }
    out.sides.push_back(std::move(side));
  }
  return out;
}

/// The stiffness on the side of every plane that `motion` is on, and the motions in the closed ones that it is in.
void beside(const VecX& motion, const OneSidedStiffness& at, MatX& stiffness, MatX& within) {
  constexpr double kIn = 1e-9;
  stiffness = at.stiffness;
  within.resize(0, motion.size());
  for (const Side& side : at.sides) {
    const double past = side.row.dot(motion);
    if (!side.closed) {
      stiffness += (past > 0 ? side.above : side.below) * side.row.transpose();
    } else if (std::abs(past) <= kIn) {
      within.conservativeResize(within.rows() + 1, Eigen::NoChange);
      within.bottomRows<1>() = side.row.transpose();
    }
  }
}

double smallest(const Released& released, const FreeStiffness& free, const OneSidedStiffness& at,
                const LeastCost& least) {
  if (!least.any) return std::numeric_limits<double>::infinity();
  if (released.at.own_origins.size() == 0) return least.cost;
  MatX stiffness, within;
  beside(least.motion, at, stiffness, within);
  const MatX& basis = free.basis;
  return in_own_metric(released.at, basis * null_space(within, kDependentRow), basis * stiffness * basis.transpose(),
                       least.cost);
}

void take(const Released& released, const FreeStiffness& free, const OneSidedStiffness& at, const LeastCost& least,
          Stability& out) {
  using Verdict = Stability::Verdict;
  out.one_way = true;
  out.told = least.told;
  out.neutral = free.basis * least.free;
  out.complex_pair = least.complex_pair;
  const bool falls = least.any && least.cost<0, nothing = out.neutral.cols()> 0 || (least.any && least.cost == 0);
  out.verdict = !least.told ? Verdict::neutral
                : falls     ? Verdict::unstable
                : nothing   ? Verdict::neutral
                            : Verdict::stable;
  out.flutter = least.oscillates && (falls || out.neutral.cols() == 0);
  out.smallest = falls || !nothing ? smallest(released, free, at, least) : 0;
  out.mode = VecX::Zero(free.basis.rows());
  if (out.neutral.cols() > 0 && !falls)
    out.mode = out.neutral.col(0);
  else if (least.any)
    out.mode = free.basis * least.motion;
}

}  // namespace

void look_one_way(const JointModel& model, const State& state, const Target& target,
                  const std::vector<double>& layer_loads, Stability& stability) {
  if (!may_be_idle(model, state, target, layer_loads)) return;
  Released released;
  if (!release(model, state, target, released)) return;
  const FreeStiffness free = free_stiffness(released.at, model.scales.length, released.cancelled);
  const OneSidedStiffness at = among(free, released.planes);
  take(released, free, at, least_cost(at), stability);
}

}  // namespace genu
