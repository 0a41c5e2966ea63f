// Where within a continuation step of a PathFollower a contact or a piece of a law changes, found without searches for
// other contacts: those follow at both sides of the place alone.
#include <cmath>
#include <limits>
#include <utility>

#include "genu/core/bracket.h"
#include "genu/path/path_cubic.h"
#include "genu/path/path_follower.h"
#include "genu/path/tolerances.h"

namespace genu {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

bool PathFollower::goes_on_to(double t, const Attempt& trial) {
  if (!trial.report.newton.converged() || !trial.valid() || passes_through(trial)) return false;
  compute_tangent_of_last(trial.pose.state, t, next_);
  return pass(t, trial);
}

std::pair<double, double> PathFollower::sides_of_change(double t, const Attempt& violated) {
  if (violated.findings.only_left_piece()) return {place_of_change(t, violated), kUnknown};
  if (violated.findings.only_a_contact()) return sides_of_contact(t, violated);
  return {kUnknown, kUnknown};
}

double PathFollower::place_of_change(double t, const Attempt& violated) {
  const JointModel& model = solver_.model();
  const double h = t - t_, middle = t_ + 0.5 * h;
  const bool alike = same_contacts(pose_.state, violated.pose.state) && tangent_.motion.twist.size() > 0 &&
                     held_count(pose_.state) == held_count(violated.pose.state);
  if (!alike) return middle;
  compute_tangent_of_last(violated.pose.state, t, between_);
  if (!tangent_.motion.twist.allFinite() || !between_.motion.twist.allFinite()) return middle;
  const double before = margin_of_change(model, violated.findings, pose_.state);
  if (!opposite(before, violated.findings.worst)) return middle;
  PathCubic cubic(model, pose_.state, tangent_.motion, violated.pose.state, between_.motion, h);
  Bracket bracket(0, before, 1, violated.findings.worst, kPlaceOfChange);
  double u = 0.5;
  State there;
  while (bracket.open()) {
    u = bracket.next();
    if (!cubic.at(u, there)) return middle;
    const double value = margin_of_change(model, violated.findings, there);
    value > 0 ? bracket.move_low(u, value) : bracket.move_high(u, value);
  }
  return t_ + u * h;
}

std::pair<double, double> PathFollower::sides_of_contact(double t, const Attempt& violated) {
  Findings found = violated.findings;
  const bool predictable = tangent_.motion.twist.size() > 0 && tangent_.motion.twist.allFinite();
  if (!predictable || !same_contacts(pose_.state, violated.pose.state)) return {kUnknown, kUnknown};
  const double beyond = solver_.margin_of_contact(violated.pose.state, found);
  Bracket bracket(t_, solver_.margin_of_contact(pose_.state, found), t, beyond, 0.5 * options_.event_tolerance);
  found = violated.findings;
  State there;
  for (int looks = 0; bracket.open(); ++looks) {
    const double u = bracket.next();
    if (looks == kMaxLooksForAChange || !prediction_.at(pose_.state, tangent_.motion, u - t_, there))
      return {kUnknown, kUnknown};
    const NewtonReport newton = solver_.solve_unchecked(there, plan_.target(u));
    iterations_ += newton.iterations;
    const double value = newton.converged() ? solver_.margin_of_contact(there, found) : kUnknown;
    if (std::isnan(value)) return {kUnknown, kUnknown};
    value > 0 ? bracket.move_low(u, value) : bracket.move_high(u, value);
  }
  // Not at the root itself, where rounding decides; together no farther apart than the tolerance.
  const double off = 0.25 * options_.event_tolerance, low = bracket.low() - off, high = bracket.high() + off;
  return {low > t_ ? low : kUnknown, high < t ? high : kUnknown};
}

}  // namespace genu
