#include "genu/path/starts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "genu/equilibrium/tolerances.h"
#include "genu/equilibrium/uniqueness.h"
#include "genu/model/ligament_pieces.h"
#include "genu/model/potential_energy.h"
#include "genu/path/tolerances.h"

namespace genu {
namespace {

/// The prime after `prime`: the base of the next coordinate.
int next_prime(int prime) {
  const auto is_prime = [](int n) {
    for (int d = 2; d * d <= n; ++d)
      if (n % d == 0) return false;
    return true;
  };
  do ++prime;
  while (!is_prime(prime));
  return prime;
}

/// The value that a coordinate is prescribed or held at; empty for a free one. A prescribed combination leaves its
/// coordinates free: the solver finds their values.
std::optional<double> fixed_value(const JointModel& model, const Target& target, const CoordinateRef& c) {
  for (const auto& p : target.prescribed)
    if (p.coordinate == QuantityRef(c)) return p.value;
  for (const auto& held : model.held)
    if (held.coordinate == c) return held.value;
  return std::nullopt;
}

bool same_pose(const JointModel& model, const State& x, const State& y, double tolerance) {
  for (std::size_t i = 0; i < x.poses.size(); ++i) {
    const double translation = (x.poses[i].p - y.poses[i].p).norm() / model.scales.length;
    const double rotation = log_rotation(x.poses[i].R * y.poses[i].R.transpose()).norm();
    if (!(std::max(translation, rotation) <= tolerance)) return false;
  }
  return true;
}

bool overlaps(const JointModel& model, ContactField& field, const State& state, double most) {
  for (int pair = 0; pair < static_cast<int>(model.pairs.size()); ++pair)
    if (field.overlap(state, pair) > most) return true;
  return false;
}

class StartsSearcher {
 public:
  StartsSearcher(const JointModel& model, ContactField& field, const Target& target,
                 const std::vector<JointValues>& first, const StartOptions& options, const Cancelled& cancelled)
      : model_(model),
        target_(target),
        first_(first),
        options_(options),
        cancelled_(cancelled),
        solver_(model, field, stoppable(options.newton, cancelled)) {}

  StartSearch run() {
    for (int k = 1; k <= options_.count && !stopped(); ++k) try_start(k);
    look_between();
    // An equilibrium found beside a saddle may be a saddle itself: the list grows during the loop.
    for (std::size_t i = 0; i < out_.equilibria.size() && i < kMaxSaddles && !stopped(); ++i) look_beside(i);
    return std::move(out_);
  }

 private:
  static constexpr std::size_t kNoPlace = std::numeric_limits<std::size_t>::max();
  struct Settled {
    Balanced pose;
    PoseReport report;
  };

  bool stopped() const { return asked_to_stop(cancelled_); }

  void try_start(int k) {
    const Settled by_newton = settle_start(k, false), down = settle_start(k, true);
    if (stopped()) return;
    ++out_.count;
    std::size_t place = add(by_newton, Equilibrium::Found::newton, k);
    if (const std::size_t below = add(down, Equilibrium::Found::downhill, k); below != kNoPlace) place = below;
    if (place == kNoPlace)
      out_.failed.push_back({k, by_newton.report});
    else
      out_.equilibria[place].starts.push_back(k);
  }

  /// Settles start `k`. Where it overlaps deeply or does not settle, tries nearer to the first one.
  Settled settle_start(int k, bool downhill) {
    Settled out;
    out.pose.last_number.assign(model_.pairs.size(), 0);
    out.report.why = "surfaces overlap";
    const double least_share = k == 1 ? 1 : kMinStartShare;
    for (double share = 1; share >= least_share; share /= 2) {
      out.pose.state = State();
      out.pose.state.coordinates = start_coordinates(model_, target_, first_, k, share, options_);
      out.pose.state.poses = poses_from_coordinates(model_, out.pose.state.coordinates);
      settle_wraps(model_, out.pose.state);
      if (k > 1 && overlaps(model_, solver_.field(), out.pose.state, options_.largest_overlap)) continue;
      // Ligaments would pull separated bodies together, and through each other, before a contact closes. Where surfaces
      // may touch, an elastic foundation comes first, unless start 1 is near.
      const bool seeded = downhill || (k > 1 && share > kMinStartShare && !model_.pairs.empty());
      out.report =
          seeded ? solver_.settle_from_seed(out.pose, target_, downhill) : solver_.settle_cold(out.pose, target_);
      if (out.report.status == PoseStatus::ok) break;
    }
    return out;
  }

  /// The equilibrium's place in the list; kNoPlace for a pose that is none.
  std::size_t add(const Settled& settled, Equilibrium::Found found, int start) {
    if (settled.report.status != PoseStatus::ok) return kNoPlace;
    for (std::size_t i = 0; i < out_.equilibria.size(); ++i)
      if (same_pose(model_, out_.equilibria[i].pose.state, settled.pose.state, options_.same_pose)) return i;
    Equilibrium e;
    e.pose = settled.pose;
    e.report = settled.report;
    e.found = found;
    e.first_start = start;
    e.stability = stability_of(solver_, e.pose, e.report, target_);
    e.energy = potential_energy(model_, e.pose.state, target_);
    out_.equilibria.push_back(std::move(e));
    return out_.equilibria.size() - 1;
  }

  /// Saddles between stable equilibria that are neighbours in the list.
  void look_between() {
    std::vector<std::size_t> stable;
    for (std::size_t i = 0; i < out_.equilibria.size() && stable.size() < kMaxBetween; ++i)
      if (out_.equilibria[i].stability.verdict == Stability::Verdict::stable) stable.push_back(i);
    for (std::size_t i = 1; i < stable.size() && !stopped(); ++i) look_between(stable[i - 1], stable[i]);
  }

  /// Drives the coordinate that differs most from one pose to the other. Its reaction is 0 at both, and at the saddle
  /// between them, where it changes sign. From near there Newton's method finds the saddle with the coordinate free.
  void look_between(std::size_t low_end, std::size_t high_end) {
    const auto from = out_.equilibria[low_end].pose.state.coordinates;
    const auto to = out_.equilibria[high_end].pose.state.coordinates;
    const int start = out_.equilibria[low_end].first_start;
    const std::optional<CoordinateRef> c = most_different(from, to);
    if (!c) return;
    const double a = from[at(c->joint)][at(c->index)], b = to[at(c->joint)][at(c->index)];
    Target driven = target_;
    driven.prescribed.push_back({QuantityRef(*c), a});
    double low = 0, high = 1;
    Settled near;
    for (int k = 0; k < kMaxBisections; ++k) {
      const double share = 0.5 * (low + high);
      driven.prescribed.back().value = a + share * (b - a);
      near = settle_between(from, to, share, driven);
      if (near.report.status != PoseStatus::ok) return;
      const double cost = near.pose.state.multipliers[driven.prescribed.size() - 1];
      (cost * (b - a) > 0 ? low : high) = share;
    }
    near.report = solver_.settle(near.pose, target_);
    add(near, Equilibrium::Found::between, start);
  }

  std::optional<CoordinateRef> most_different(const std::vector<JointValues>& from,
                                              const std::vector<JointValues>& to) const {
    std::optional<CoordinateRef> out;
    double most = 0;
    for (int j = 0; j < static_cast<int>(from.size()); ++j) {
      for (int i = 0; i < 6; ++i) {
        const double change = std::abs(to[at(j)][at(i)] - from[at(j)][at(i)]) / (i < 3 ? 1 : model_.scales.length);
        if (!(change > most) || fixed_value(model_, target_, {j, i})) continue;
        most = change;
        out = CoordinateRef{j, i};
      }
    }
    return out;
  }

  Settled settle_between(const std::vector<JointValues>& from, const std::vector<JointValues>& to, double share,
                         const Target& driven) {
    Settled out;
    out.pose.last_number.assign(model_.pairs.size(), 0);
    out.pose.state.coordinates = from;
    for (std::size_t j = 0; j < from.size(); ++j)
      for (std::size_t i = 0; i < 6; ++i) out.pose.state.coordinates[j][i] += share * (to[j][i] - from[j][i]);
    out.pose.state.poses = poses_from_coordinates(model_, out.pose.state.coordinates);
    settle_wraps(model_, out.pose.state);
    if (!overlaps(model_, solver_.field(), out.pose.state, options_.largest_overlap))
      out.report = solver_.settle_from_seed(out.pose, driven, true);
    return out;
  }

  void look_beside(std::size_t saddle) {
    if (out_.equilibria[saddle].stability.verdict != Stability::Verdict::unstable) return;
    for (const double sign : {1.0, -1.0}) {
      // By index: the list may be reallocated.
      const Equilibrium& e = out_.equilibria[saddle];
      const int start = e.first_start;
      Settled beside;
      beside.pose.last_number.assign(model_.pairs.size(), 0);
      if (!displaced(e, sign * kBesideSaddle, beside.pose.state)) continue;
      beside.report = solver_.settle_from_seed(beside.pose, target_, true);
      add(beside, Equilibrium::Found::beside, start);
    }
  }

  /// The saddle moved by `way` (rad or 10 mm) along its mode, with contacts open.
  bool displaced(const Equilibrium& saddle, double way, State& out) const {
    State from = saddle.pose.state;
    from.contacts.clear();
    for (LigamentPiece& piece : from.pieces) piece.held = false;
    Correction along;
    along.resize(model_.moving_count, static_cast<int>(from.multipliers.size()), 0);
    along.multipliers.setZero();
    along.twist = saddle.stability.mode;
    for (Eigen::Index i = 0; i < along.twist.size(); ++i)
      if (i % 6 < 3) along.twist[i] *= kMetricLength;
    return retract(model_, from, along, way, out);
  }

  const JointModel& model_;
  const Target& target_;
  const std::vector<JointValues>& first_;
  const StartOptions& options_;
  const Cancelled& cancelled_;
  ActiveSetSolver solver_;
  StartSearch out_;
};

}  // namespace

double van_der_corput(int index, int base) {
  double value = 0, digit = 1;
  for (int rest = index + 1; rest > 0; rest /= base) value += (digit /= base) * (rest % base);
  return value;
}

std::vector<JointValues> start_coordinates(const JointModel& model, const Target& target,
                                           const std::vector<JointValues>& first, int k, double share,
                                           const StartOptions& options) {
  std::vector<JointValues> out;
  int base = 2;
  for (int j = 0; j < static_cast<int>(model.joints.size()); ++j) {
    JointValues q = first[at(j)];
    for (int i = 0; i < 6; ++i) {
      if (const auto fixed = fixed_value(model, target, {j, i})) {
        q[at(i)] = *fixed;
        continue;
      }
      const double most = i < 3 ? options.angle : options.translation * model.scales.length;
      if (k > 1) q[at(i)] += share * most * (2 * van_der_corput(k - 2, base) - 1);
      base = next_prime(base);
    }
    out.push_back(q);
  }
  return out;
}

StartSearch search_starts(const JointModel& model, ContactField& field, const Target& target,
                          const std::vector<JointValues>& first, const StartOptions& options,
                          const Cancelled& cancelled) {
  return StartsSearcher(model, field, target, first, options, cancelled).run();
}

const char* to_string(Equilibrium::Found found) {
  switch (found) {
    case Equilibrium::Found::newton:
      return "newton";
    case Equilibrium::Found::downhill:
      return "downhill";
    case Equilibrium::Found::between:
      return "between two";
    case Equilibrium::Found::beside:
      return "beside a saddle";
  }
  return "";
}

}  // namespace genu
