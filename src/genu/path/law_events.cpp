#include "genu/path/law_events.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "genu/equilibrium/piece_changes.h"
#include "genu/equilibrium/tolerances.h"
#include "genu/path/tolerances.h"

namespace genu {
namespace {

/// The cubic with given values and slopes at 0 and 1.
struct Cubic {
  double c0, c1, c2, c3;

  Cubic(double value_0, double slope_0, double value_1, double slope_1)
      : c0(value_0),
        c1(slope_0),
        c2(3 * (value_1 - value_0) - 2 * slope_0 - slope_1),
        c3(2 * (value_0 - value_1) + slope_0 + slope_1) {}

  double value(double s) const { return c0 + s * (c1 + s * (c2 + s * c3)); }
  double slope(double s) const { return c1 + s * (2 * c2 + s * 3 * c3); }

  /// Its extrema strictly between 0 and 1, in order.
  int extrema(std::array<double, 2>& out) const {
    // The roots of 3 c3 s^2 + 2 c2 s + c1 without cancellation.
    const double discriminant = c2 * c2 - 3 * c3 * c1;
    if (!(discriminant > 0)) return 0;
    const double q = -(c2 + std::copysign(std::sqrt(discriminant), c2));
    int count = 0;
    for (const double s : {q / (3 * c3), c1 / q})
      if (s > 0 && s < 1) out[static_cast<std::size_t>(count++)] = s;  // not where c3 or q is 0
    if (count == 2 && out[0] > out[1]) std::swap(out[0], out[1]);
    return count;
  }

  /// The root between 0 and 1, where the signs differ.
  double root() const {
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      ((value(middle) > 0) == (c0 > 0) ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
};

}  // namespace

LawEvents::LawEvents(const JointModel& model, bool locate)
    : model_(&model), rounding_(kLengthRounding * model.scales.length) {
  if (!locate) return;
  for (std::size_t i = 0; i < model.ligaments.size(); ++i)
    for (const LawBreak& b : model.ligaments[i].law.breaks())
      if (!b.sharp()) watched_.push_back({static_cast<int>(i), b});
}

const std::vector<LawEvents::Passed>& LawEvents::over(const End& from, const End& to, double tolerance,
                                                      const Solves& solves) {
  passed_.clear();
  solves_ = &solves;
  tolerance_ = tolerance;
  for (Watched& w : watched_) {
    const Node first = node(w, from, 0), last = node(w, to, 1);
    if (!begun_) w.above = first.past > 0;
    if (solves.pose_at)
      follow(w, first, last, to.state);
    else
      pass(w, last, last, to.state);
  }
  begun_ = true;
  std::stable_sort(passed_.begin(), passed_.end(), [](const Passed& x, const Passed& y) { return x.u < y.u; });
  return passed_;
}

double LawEvents::length(const Watched& w, const State& state) const {
  return model_->ligaments[at(w.ligament)].path.length(state.poses, state.wraps);
}

LawEvents::Node LawEvents::node(const Watched& w, const End& end, double u) const {
  Node out{u, length(w, end.state) - w.law_break.length, std::numeric_limits<double>::quiet_NaN()};
  if (end.twist)
    out.rate = model_->ligaments[at(w.ligament)].path.length_rate(end.state.poses, *end.twist, end.state.wraps);
  return out;
}

void LawEvents::follow(Watched& w, const Node& from, const Node& to, const State& end) {
  // A ligament may pass a break and return within the step, so extrema are examined. The cubic has an error: an
  // extremum that comes within a hundredth of its rise to the break is examined too, and the pose there decides.
  const Cubic cubic(from.past, from.rate, to.past, to.rate);
  std::array<double, 2> extrema{};
  const int count = cubic.extrema(extrema);
  Node last = from;
  for (int i = 0; i < count; ++i) {
    const double u = extrema[at(i)], past = cubic.value(u);
    const double rise = std::min(std::abs(past - from.past), std::abs(past - to.past));
    const bool beyond = (past > 0) != (from.past > 0) || (past > 0) != (to.past > 0);
    if (!beyond && std::abs(past) > kNearBreakShare * rise) continue;
    Node there{u, past, 0};
    solve(w, u, there.past);
    pass(w, last, there, end);
    last = there;
  }
  pass(w, last, to, end);
}

void LawEvents::pass(Watched& w, const Node& from, const Node& to, const State& end) {
  if (std::abs(to.past) <= rounding_ || (to.past > 0) == w.above) return;
  w.above = to.past > 0;
  passed_.push_back({to.u, passed(w.law_break, w.above), model_->ligaments[at(w.ligament)].name, end});
  locate(w, from, to, passed_.back());
}

void LawEvents::locate(const Watched& w, const Node& from, const Node& to, Passed& out) {
  const double span = to.u - from.u;
  // Already within rounding of the break at the start, or no solver for poses between.
  out.u = (from.past > 0) == (to.past > 0) ? from.u : to.u;
  if (out.u == from.u || span <= tolerance_) return;
  const bool smooth = std::isfinite(from.rate) && std::isfinite(to.rate);
  const double secant = to.past - from.past;
  const Cubic cubic(from.past, smooth ? span * from.rate : secant, to.past, smooth ? span * to.rate : secant);
  double low = 0, high = 1, s = cubic.root(), slope = cubic.slope(s);
  if (solve_event(w, from, to, from.u + s * span, out)) return;
  double last_s = s, last_past = 0;
  for (int i = 0; i < 40; ++i) {
    double past = 0;
    if (!solve(w, from.u + s * span, past)) break;
    out.state = between_;
    if (std::abs(past) <= rounding_) break;
    ((past > 0) == (from.past > 0) ? low : high) = s;
    if (i > 0 && s != last_s) slope = (past - last_past) / (s - last_s);
    last_s = s;
    last_past = past;
    const double next = s - past / slope;
    if (std::abs(next - s) * span <= tolerance_) {
      s = std::clamp(next, low, high);
      break;
    }
    s = next > low && next < high ? next : 0.5 * (low + high);
    if ((high - low) * span <= tolerance_) break;
  }
  out.u = from.u + s * span;
}

/// The event between two nodes, from a guess. `out` is unchanged where that fails.
bool LawEvents::solve_event(const Watched& w, const Node& from, const Node& to, double u, Passed& out) {
  if (!solves_->event_at || !solves_->event_at(w.ligament, w.law_break.length, u, between_)) return false;
  if (u < from.u || u > to.u) return false;
  out.u = u;
  out.state = between_;
  return true;
}

bool LawEvents::solve(const Watched& w, double u, double& past) {
  if (!solves_->pose_at(u, between_)) return false;
  past = length(w, between_) - w.law_break.length;
  return true;
}

}  // namespace genu
