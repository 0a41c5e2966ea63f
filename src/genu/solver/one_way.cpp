#include "genu/solver/one_way.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "genu/contact/elastic_layer.h"
#include "genu/model/ligament_pieces.h"
#include "genu/solver/moving_blocks.h"

namespace genu {
namespace {

constexpr double kPressed = 1e-9;  // what a motion of unit norm closes or stretches by less is rounding
constexpr double kHardly = 1e-9;   // of the force scale: what presses or pulls by more is not idle

/// A ligament that is about to become taut, or hardly is.
struct Barely {
  double stiffness = 0;  ///< N/m, of the side it is on
  bool resists = false;  ///< a longer one pulls at once: no toe begins here
};

/// Empty for a ligament that pulls with more than `force` (N), is slack, or held at a jump of its force.
std::optional<Barely> barely_taut(const JointModel& model, const State& state, std::size_t i, double force) {
  const auto& l = model.ligaments[i];
  const LigamentLaw& law = l.ligament.law;
  if (law.slack_until() < 0) return {};
  const double length = ligament_length(l, state.poses), beyond = length - law.slack_until();
  const double rounding = 1e-14 * model.scales.length;
  if (beyond < -rounding) return {};
  const auto piece = std::find_if(state.pieces.begin(), state.pieces.end(),
                                  [&](const LigamentPiece& p) { return at(p.ligament) == i && !p.by_length; });
  if (piece != state.pieces.end() && piece->held) return {};
  const LawValue pull = law.evaluate(length, piece == state.pieces.end() ? LigamentLaw::kByLength : piece->piece);
  if (beyond > rounding && std::abs(pull.force) > force) return {};
  return Barely{pull.stiffness, law.breaks().front().above.stiffness > 0};
}

/// Whether there is anything to let go, told without the equations.
bool may_be_idle(const JointModel& model, const State& state, const std::vector<double>& layer_loads) {
  const double hardly = kHardly * model.scales.force;
  for (const double load : layer_loads)
    if (load <= hardly) return true;
  for (const ActiveContact& c : state.contacts)
    if (std::abs(c.force) <= hardly) return true;
  for (std::size_t i = 0; i < model.ligaments.size(); ++i)
    if (const auto barely = barely_taut(model, state, i, hardly); barely && barely->stiffness > 0) return true;
  return false;
}

/// N: twice what the forces at the pose fail to balance.
double idle_force(const JointModel& model, const Linearization& at) {
  constexpr double kRounding = 1e-15;
  double unbalanced = 0;
  for (Eigen::Index i = 0; i < at.wrench.size(); ++i)
    unbalanced = std::max(unbalanced, std::abs(at.wrench[i]) / (i % 6 < 3 ? 1 : model.scales.length));
  return std::min(2 * unbalanced + kRounding * model.scales.force, kHardly * model.scales.force);
}

/// The pose without what is idle, and of that a row each: how fast a twist closes the contact or stretches the
/// ligament.
struct Released {
  Linearization at;
  MatX presses;          ///< rows of unit norm, over motions in the metric
  double cancelled = 0;  ///< J: the size of what was taken out of the stiffness, in the metric
};

void add_row(const VecX& row, const VecX& unit, MatX& rows) {
  const VecX scaled = unit.cwiseProduct(row);
  if (!(scaled.norm() > 0)) return;
  rows.conservativeResize(rows.rows() + 1, row.size());
  rows.bottomRows<1>() = scaled.normalized().transpose();
}

/// Moves the contacts that carry no more than `force` out of `state`.
bool release_contacts(const Linearization& at_pose, double force, const VecX& unit, State& state, MatX& presses) {
  std::vector<ActiveContact> kept;
  for (std::size_t c = 0; c < state.contacts.size(); ++c) {
    if (std::abs(state.contacts[c].force) > force) {
      kept.push_back(state.contacts[c]);
      continue;
    }
    VecX row = VecX::Zero(unit.size());
    for (int side = 0; side < 2; ++side)
      if (const int body = at_pose.contact_bodies[c][at(side)]; body >= 0)
        row.segment<6>(6 * body) -= at_pose.contacts[c].direction.segment<6>(6 * side);
    add_row(row, unit, presses);
  }
  const bool any = kept.size() < state.contacts.size();
  state.contacts = std::move(kept);
  return any;
}

/// The stiffness falls by k g g^T, g = dL/dX.
void release_ligament(const JointModel& model, const State& state, std::size_t i, const Barely& barely,
                      const VecX& unit, Released& out) {
  VecX gradient(unit.size());
  for (Eigen::Index j = 0; j < unit.size(); ++j)
    gradient[j] = ligament_length_rate(model, model.ligaments[i], state.poses, VecX::Unit(unit.size(), j));
  out.at.stiffness += barely.stiffness * gradient * gradient.transpose();
  out.cancelled += barely.stiffness * gradient.cwiseProduct(unit).squaredNorm();
  if (barely.resists) add_row(gradient, unit, out.presses);
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
  const double force = idle_force(model, out.at);
  const VecX unit = stability_metric(out.at.wrench.size());
  out.presses.resize(0, unit.size());
  State loose = state;
  bool any = release_contacts(out.at, force, unit, loose, out.presses);
  if (any) linearize(model, loose, target, out.at);
  any = release_layers(model, state, force, out.at) || any;
  for (std::size_t i = 0; i < model.ligaments.size(); ++i) {
    const auto barely = barely_taut(model, state, i, force);
    if (!barely) continue;
    any = any || barely->stiffness > 0;
    release_ligament(model, state, i, *barely, unit, out);
  }
  return any;
}

bool presses_nothing(const MatX& presses, const VecX& motion) {
  return presses.rows() == 0 || (presses * motion).maxCoeff() <= kPressed * motion.norm();
}

/// A motion among `motions` (columns) that presses nothing and leaves something, of zeros where there is none. With
/// R = presses * motions it is -R^T y for the y >= 1 that makes that least (Hildreth's method): 0 if R y = 0 for some y
/// > 0, which by Stiemke's theorem is the case where no such motion exists.
VecX way_out(const MatX& presses, const MatX& motions) {
  if (presses.rows() == 0) return motions.col(0);
  const MatX rates = presses * motions;
  VecX y = VecX::Ones(rates.rows()), left = rates.transpose() * y;
  constexpr int kSweeps = 1000;
  constexpr double kNone = 1e-6;  // of what is left: no way out
  for (int sweep = 0; sweep < kSweeps && left.norm() > kNone * y.norm(); ++sweep) {
    const VecX before = y;
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      const double norm = rates.row(i).squaredNorm();
      if (norm < kPressed * kPressed) continue;
      const double next = std::max(1.0, y[i] - rates.row(i).dot(left) / norm);
      left += (next - y[i]) * rates.row(i).transpose();
      y[i] = next;
    }
    if ((y - before).norm() <= 1e-14 * y.norm()) break;
  }
  const VecX out = left.norm() > kNone * y.norm() ? VecX(-motions * left.normalized()) : VecX::Zero(motions.rows());
  return presses_nothing(presses, out) ? out : VecX::Zero(motions.rows());
}

}  // namespace

void look_one_way(const JointModel& model, const State& state, const Target& target,
                  const std::vector<double>& layer_loads, Stability& stability) {
  if (stability.verdict == Stability::Verdict::unstable || !may_be_idle(model, state, layer_loads)) return;
  Released released;
  if (!release(model, state, target, released)) return;
  const Stability loose = assess_stability(released.at, model.scales.length, released.cancelled);
  const auto take = [&](Stability::Verdict verdict, double smallest, const VecX& motion) {
    stability.verdict = verdict;
    stability.smallest = smallest;
    stability.mode = motion;
    stability.one_way = true;
  };
  if (loose.verdict == Stability::Verdict::unstable)
    for (const double sign : {1.0, -1.0})
      if (const VecX motion = sign * loose.mode; presses_nothing(released.presses, motion))
        return take(Stability::Verdict::unstable, loose.smallest, motion);
  if (loose.neutral.cols() == 0) return;
  const VecX motion = way_out(released.presses, loose.neutral);
  if (motion.isZero(0)) return;
  take(Stability::Verdict::neutral, 0, motion);
  stability.neutral.conservativeResize(motion.size(), stability.neutral.cols() + 1);
  stability.neutral.rightCols<1>() = motion;
}

}  // namespace genu
