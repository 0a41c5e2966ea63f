#include "genu/solver/one_way.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "genu/contact/elastic_layer.h"
#include "genu/model/ligament_pieces.h"
#include "genu/solver/moving_blocks.h"
#include "genu/solver/way_out.h"

namespace genu {
namespace {

constexpr double kHardly = 1e-9;  // of the force scale: what presses or pulls by more is not idle

/// A ligament that is about to become taut, or hardly is.
struct Barely {
  double stiffness = 0;  ///< N/m, of the side it is on
  double beyond = 0;     ///< N/m, of a longer one: 0 where a toe begins
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
  return Barely{pull.stiffness, std::max(0.0, law.breaks().front().above.stiffness)};
}

/// Whether there is anything to let go, told without the equations.
bool may_be_idle(const JointModel& model, const State& state, const std::vector<double>& layer_loads) {
  const double hardly = kHardly * model.scales.force;
  for (const double load : layer_loads)
    if (load <= hardly) return true;
  for (const ActiveContact& c : state.contacts)
    if (std::abs(c.force) <= hardly) return true;
  for (std::size_t i = 0; i < model.ligaments.size(); ++i)
    if (const auto barely = barely_taut(model, state, i, hardly);
        barely && (barely->stiffness > 0 || barely->beyond > 0))
      return true;
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

/// What holds one way: a contact, or a ligament that pulls at once where it becomes longer.
struct OneSided {
  VecX gradient;         ///< how fast a twist (6B) closes the contact, stretches the ligament
  VecX row;              ///< the same of unit norm, over motions in the metric
  double stiffness = 0;  ///< N/m, of the ligament once it is longer
  bool contact = false;
};

/// The pose without what is idle, and that.
struct Released {
  Linearization at;
  std::vector<OneSided> sides;
  double cancelled = 0;  ///< J: the size of what was taken out of the stiffness, in the metric
};

void add_side(const VecX& gradient, double stiffness, bool contact, const VecX& unit, std::vector<OneSided>& sides) {
  const VecX scaled = unit.cwiseProduct(gradient);
  if (scaled.norm() > 0) sides.push_back({gradient, scaled.normalized(), stiffness, contact});
}

/// Moves the contacts that carry no more than `force` out of `state`.
bool release_contacts(const Linearization& at_pose, double force, const VecX& unit, State& state,
                      std::vector<OneSided>& sides) {
  std::vector<ActiveContact> kept;
  for (std::size_t c = 0; c < state.contacts.size(); ++c) {
    if (std::abs(state.contacts[c].force) > force) {
      kept.push_back(state.contacts[c]);
      continue;
    }
    VecX closing = VecX::Zero(unit.size());
    for (int side = 0; side < 2; ++side)
      if (const int body = at_pose.contact_bodies[c][at(side)]; body >= 0)
        closing.segment<6>(6 * body) -= at_pose.contacts[c].direction.segment<6>(6 * side);
    add_side(closing, 0, true, unit, sides);
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
  const double size = gradient.cwiseProduct(unit).squaredNorm();
  out.cancelled += std::max(barely.stiffness, barely.beyond) * size;
  if (barely.beyond > 0) add_side(gradient, barely.beyond, false, unit, out.sides);
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
  State loose = state;
  bool any = release_contacts(out.at, force, unit, loose, out.sides);
  if (any) linearize(model, loose, target, out.at);
  any = release_layers(model, state, force, out.at) || any;
  for (std::size_t i = 0; i < model.ligaments.size(); ++i) {
    const auto barely = barely_taut(model, state, i, force);
    if (!barely) continue;
    any = any || barely->stiffness > 0 || barely->beyond > 0;
    release_ligament(model, state, i, *barely, unit, out);
  }
  return any;
}

/// What each of the sides does along a motion.
enum class Doing { gives, resists, keeps };

/// The pose with each side doing what `doing` says, and the rows that motions may not exceed 0 along to leave it so.
struct Piece {
  Linearization at;
  MatX bounds;
};

Piece piece_of(const Released& released, const std::vector<Doing>& doing) {
  Piece out{released.at, MatX(0, released.at.wrench.size())};
  const auto append = [](const VecX& row, MatX& rows) {
    rows.conservativeResize(rows.rows() + 1, row.size());
    rows.bottomRows<1>() = row.transpose();
  };
  for (std::size_t i = 0; i < doing.size(); ++i) {
    const OneSided& side = released.sides[i];
    if (doing[i] == Doing::keeps) {
      append(side.gradient, out.at.gradient);
      out.at.constraint.conservativeResize(out.at.constraint.size() + 1);
      out.at.constraint.tail<1>().setZero();
      continue;
    }
    append(doing[i] == Doing::gives ? side.row : VecX(-side.row), out.bounds);
    if (doing[i] == Doing::resists) out.at.stiffness -= side.stiffness * side.gradient * side.gradient.transpose();
  }
  return out;
}

/// The next combination, as one counts; false behind the last.
bool next(const std::vector<OneSided>& sides, std::vector<Doing>& doing) {
  for (std::size_t i = 0; i < doing.size(); ++i) {
    const bool contact = sides[i].contact;  // one that is closed does not move
    doing[i] = doing[i] == Doing::gives && !contact ? Doing::resists
               : doing[i] == Doing::keeps           ? Doing::gives
                                                    : Doing::keeps;
    if (doing[i] != Doing::gives) return true;
  }
  return false;
}

/// The least that a motion costs, over all pieces: it is an eigenvector of the smallest eigenvalue of the piece, or of
/// the face of one, that it lies in.
struct Least {
  Stability::Verdict verdict = Stability::Verdict::stable;
  double smallest = std::numeric_limits<double>::infinity();
  VecX motion;
  MatX neutral;  ///< motions that cost nothing, a column each
};

/// Those of `motions` (columns) that are within the bounds, this way or the other; where none is by itself, a sum that
/// is.
MatX ways_out(const MatX& bounds, const MatX& motions) {
  MatX out(motions.rows(), 0);
  if (motions.cols() == 0) return out;
  const auto add = [&out](const VecX& motion) {
    out.conservativeResize(Eigen::NoChange, out.cols() + 1);
    out.rightCols<1>() = motion;
  };
  for (Eigen::Index i = 0; i < motions.cols(); ++i)
    if (within(bounds, motions.col(i)))
      add(motions.col(i));
    else if (within(bounds, -motions.col(i)))
      add(-motions.col(i));
  if (out.cols() > 0) return out;
  if (const VecX motion = way_out(bounds, motions); !motion.isZero(0)) add(motion);
  return out;
}

void take_lower(const Stability& piece, const MatX& bounds, Least& least) {
  MatX ways = ways_out(bounds, piece.neutral);
  if (ways.cols() == 0) ways = least.neutral;  // of another piece: they cost nothing all the same
  if (piece.verdict != Stability::Verdict::neutral && piece.free_motions > 0)
    for (const double sign : {1.0, -1.0})
      if (const VecX motion = sign * piece.mode; within(bounds, motion) && piece.smallest < least.smallest)
        least = {piece.verdict, piece.smallest, motion, ways};
  if (ways.cols() > 0 && least.smallest > 0) {
    const VecX motion = ways.col(0);
    least = {Stability::Verdict::neutral, 0, motion, ways};
  }
  if (least.neutral.cols() == 0) least.neutral = std::move(ways);  // something else costs less than nothing
}

}  // namespace

void look_one_way(const JointModel& model, const State& state, const Target& target,
                  const std::vector<double>& layer_loads, Stability& stability) {
  if (!may_be_idle(model, state, layer_loads)) return;
  Released released;
  if (!release(model, state, target, released)) return;
  constexpr std::size_t kMost = 7;  // sides, of up to three pieces each
  std::vector<Doing> doing(released.sides.size(), Doing::gives);
  Least least{stability.verdict, stability.smallest, stability.mode, stability.neutral};
  const bool all = doing.size() <= kMost;
  if (all) least = {};
  do {
    const Piece piece = piece_of(released, doing);
    take_lower(assess_stability(piece.at, model.scales.length, released.cancelled), piece.bounds, least);
  } while (all && next(released.sides, doing));
  stability.verdict = least.verdict;
  stability.smallest = least.smallest;
  stability.one_way = true;
  stability.neutral = least.neutral.rows() > 0 ? least.neutral : MatX(released.at.wrench.size(), 0);
  if (least.motion.size() > 0) stability.mode = least.motion;
}

}  // namespace genu
