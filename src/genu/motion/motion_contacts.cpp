#include "genu/motion/motion_contacts.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/core/bracket.h"
#include "genu/equilibrium/tolerances.h"
#include "genu/equilibrium/uniqueness.h"
#include "genu/motion/contact_choice.h"
#include "genu/motion/tolerances.h"

namespace genu {
namespace {

PathEvent event_of(PathEvent::Kind kind, const MotionPoint& point, std::string what) {
  PathEvent event;
  event.kind = kind;
  event.step = 1;
  event.target.time = point.time;
  event.what = std::move(what);
  event.coordinates = point.state.coordinates;
  return event;
}

/// The gap (m) at a minimum followed to `point`, and its rate (m/s); NaN where the minimum is lost.
struct Opening {
  double gap = std::nan(""), rate = std::nan("");
};

Opening opening_of(const JointModel& model, const Candidate& minimum, const MotionPoint& point) {
  ActiveContact contact{minimum.pair, 0, minimum.minimum.contact, 0};
  ClosedContact closed;
  if (!evaluate_closed(model, point.state, contact, closed)) return {};
  return {closed.gap, closed.gradient.dot(twist_at(model, contact, point.twist))};
}

/// The zero of `value`, positive at `from` and negative at `to`; `to` where it cannot be located.
MotionPoint locate(const MotionPoint& from, const MotionPoint& to, const MotionContacts::PointAt& point_at,
                   const std::function<double(const MotionPoint&)>& value, double tolerance) {
  const double first = value(from), last = value(to);
  if (!(first > 0) || !(last < 0)) return to;
  const double in_time = std::max(1e-15 * std::abs(to.time), 1e-13 * (to.time - from.time));
  Bracket bracket(from.time, first, to.time, last, in_time);
  MotionPoint found = to, trial;
  while (bracket.open()) {
    const double t = bracket.next();
    if (!point_at(t, trial)) return to;
    const double here = value(trial);
    found = trial;
    if (std::abs(here) <= tolerance) break;
    if (here > 0)
      bracket.move_low(t, here);
    else
      bracket.move_high(t, here);
  }
  return found;
}

bool bends_away(const JointModel& model, const State& state, const ActiveContact& contact, double least) {
  return least_curvature(model, state, contact) >= least;
}

}  // namespace

MotionContacts::MotionContacts(const JointModel& model, EquationsOfMotion& equations, double tolerance,
                               const Cancelled& cancelled)
    : model_(model),
      equations_(equations),
      field_(model),
      solver_(model, field_, stoppable({}, cancelled)),
      inspector_(model, field_),
      touching_(std::max(inspector_.gap_tolerance(), kStepErrors * tolerance * model.scales.length)) {
  for (const auto& pair : model.pairs) watches_.emplace_back(model, pair.body_a, pair.body_b, *pair.a, *pair.b);
}

bool MotionContacts::balance(MotionPoint& point, std::string& why) {
  const Target target = equations_.target_at(point.time);
  Balanced pose;
  pose.state = point.state;
  fit_multipliers(model_, target, pose.state);
  const PoseReport report = solver_.settle_cold(pose, target);
  if (report.status != PoseStatus::ok) {
    why = fmt::format("no equilibrium to start from: {}{}", to_string(report.status),
                      report.why.empty() ? "" : ", " + report.why);
    return false;
  }
  const auto unstable = [&](const Balanced& there, const PoseReport& as) {
    return stability_of(solver_, there, as, target).verdict == Stability::Verdict::unstable;
  };
  if (unstable(pose, report)) {
    Balanced lower;
    lower.state = point.state;
    fit_multipliers(model_, target, lower.state);
    const PoseReport found = solver_.settle_from_seed(lower, target, true);
    if (found.status != PoseStatus::ok || unstable(lower, found)) {
      why =
          "the equilibrium nearest to the joints' `start` is unstable, and none that is stable was found downhill from "
          "there";
      return false;
    }
    pose = lower;
  }
  point.state = pose.state;
  book_ = pose;
  return true;
}

bool MotionContacts::begin(MotionPoint& point, std::string& why) {
  Findings findings;
  inspector_.inspect(point.state, findings);
  if (findings.final()) {
    why = findings.doubtful    ? "the contact touches " + findings.where
          : findings.over_edge ? findings.where + " lies past the edge of its surface at the start"
                               : "surfaces overlap at the start: " + findings.where;
    return false;
  }
  Survey survey;
  field_.survey(point.state, survey);
  const double length = model_.scales.length;
  book_.state = point.state;
  for (const Candidate& c : survey.minima) {
    if (inspector_.held(book_.state, c) || c.minimum.gap > kTouchingAtStart * length) continue;
    if (c.minimum.gap < -kOverlappingAtStart * length) {
      why = fmt::format(
          "surfaces of contact.{} overlap by {:.4g} mm at the start: move the joints' `start`, or begin at equilibrium "
          "(start = \"equilibrium\" in [dynamics])",
          model_.pairs[at(c.pair)].name, -1e3 * c.minimum.gap);
      return false;
    }
    solver_.close(book_, c);
  }
  point.state.contacts = book_.state.contacts;
  std::vector<PathEvent> none;
  return settle(point, -1, none, why);
}

/// Whether the two points are close enough that a search at the second shows every contact: open gaps change by less
/// than the search window, or than the known clearance.
bool MotionContacts::near(const MotionPoint& from, const MotionPoint& to) {
  for (int k = 0; k < static_cast<int>(model_.pairs.size()); ++k) {
    const double way = watches_[at(k)].way(from, to);
    const bool held = std::any_of(from.state.contacts.begin(), from.state.contacts.end(),
                                  [&](const ActiveContact& c) { return c.pair == k; });
    const double unwatched = held ? watches_[at(k)].unwatched : std::min(watches_[at(k)].unwatched, field_.window());
    if (way <= unwatched) continue;
    if (held || !field_.is_clear(from.state, k, way / kClearanceShare)) return false;
  }
  return true;
}

/// Whether no gap that was open at the last search can have closed since, and no contact pulls: no search is needed.
bool MotionContacts::known_clear(const MotionPoint& from, const MotionPoint& to) {
  bool clear = model_.layers.empty();
  for (const ActiveContact& c : to.state.contacts) clear = clear && c.force >= -kPullTolerance * model_.scales.force;
  for (int k = 0; k < static_cast<int>(watches_.size()); ++k) {
    MotionWatch& watch = watches_[at(k)];
    watch.travelled += watch.way(from, to);
    clear = clear && watch.travelled < kClearanceShare * watch.clearance;
  }
  return clear && std::none_of(to.state.contacts.begin(), to.state.contacts.end(),
                               [&](const ActiveContact& c) { return born_beside(to.state, c); });
}

/// Whether surfaces overlap beside a contact with small relative curvature, or such a contact may be about to split.
bool MotionContacts::born_beside(const State& state, const ActiveContact& contact) {
  const double spacing = field_.spacing();
  if (bends_away(model_, state, contact, kTwinCurvature / spacing)) return false;
  if (!bends_away(model_, state, contact, kSplittingCurvature / spacing)) return true;
  beside_.clear();
  for (const double radius : kProbeRadii)
    field_.probe_around(state, contact.pair, contact.geometry, radius * spacing, kValleyCurvature / spacing, beside_);
  return std::any_of(beside_.begin(), beside_.end(), [&](const LocalMinimum& m) {
    const Candidate candidate{contact.pair, m};
    return m.gap < -allowed_overlap(state, candidate) && !inspector_.held(state, candidate);
  });
}

/// m: overlap at a minimum of the gap that is not reported. Beside a contact with small relative curvature it is almost
/// zero: that contact may be about to vanish, and this minimum then takes over its load.
double MotionContacts::allowed_overlap(const State& state, const Candidate& candidate) const {
  const bool twin = std::any_of(state.contacts.begin(), state.contacts.end(), [&](const ActiveContact& c) {
    return c.pair == candidate.pair && !bends_away(model_, state, c, kTwinCurvature / field_.spacing());
  });
  return twin ? kTwinGap * touching_ : touching_;
}

/// A search without findings for the inspector; it updates all clearances.
bool MotionContacts::looks_well(const MotionPoint& point) {
  field_.survey(point.state, survey_);
  std::vector<double> explained(watches_.size(), 0.0);
  for (MotionWatch& watch : watches_) watch.travelled = 0, watch.clearance = field_.window();
  for (const Candidate& c : survey_.minima) {
    explained[at(c.pair)] = std::min(explained[at(c.pair)], c.minimum.gap);
    if (inspector_.held(point.state, c)) continue;
    if (c.minimum.gap < -allowed_overlap(point.state, c)) return false;
    watches_[at(c.pair)].clearance = std::min(watches_[at(c.pair)].clearance, std::max(0.0, c.minimum.gap));
  }
  for (const Candidate& c : survey_.edges)
    if (c.minimum.gap < -touching_ && !inspector_.held(point.state, c)) return false;
  for (std::size_t k = 0; k < explained.size(); ++k)
    if (survey_.smallest_gap[k] < explained[k] - kUnexplainedOverlap * model_.scales.length) return false;
  for (std::size_t i = 0; i < point.state.contacts.size(); ++i) {
    const ActiveContact& c = point.state.contacts[i];
    if (c.force < 0 || field_.edge_distance(c.pair, c.geometry) < 0) return false;
    const double least = least_curvature(model_, point.state, c), beside = kProbeRadii[3] * field_.spacing();
    if (least < kSplittingCurvature / field_.spacing()) return false;
    // At the end of the range searched beside a contact, the gap is about this large.
    watches_[at(c.pair)].clearance = std::min(watches_[at(c.pair)].clearance, 0.5 * least * beside * beside);
    for (std::size_t j = 0; j < i; ++j)
      if (point.state.contacts[j].pair == c.pair &&
          same_place(point.state.contacts[j].geometry, c.geometry, inspector_.same_contact()))
        return false;
  }
  return !field_.any_doubtful() && model_.layers.empty();
}

MotionContacts::Change MotionContacts::first_change(const MotionPoint& from, const MotionPoint& to,
                                                    const PointAt& point_at) {
  if (known_clear(from, to)) return {};
  MotionPoint here = from;
  for (bool all = false; !all;) {
    MotionPoint next = to;
    all = true;
    for (int k = 0; k < kMaxHalvings && !near(here, next); ++k) {
      all = false;
      const double middle = 0.5 * (here.time + next.time);
      if (!(middle > here.time) || !point_at(middle, next)) break;
    }
    Change change;
    if (!looks_well(next))
      change = first_seen(here, next, point_at);
    else if (const auto lowest = overlap_between(here, next, point_at))
      change = first_seen(here, *lowest, point_at);
    if (change.kind != Change::Kind::none) return change;
    here = next;
  }
  if (!book_.open.empty()) {
    book_.state = to.state;
    solver_.follow_open(book_);
  }
  return {};
}

/// The minimum in time of a gap that decreases at `from` and increases at `to`: the earliest point where surfaces
/// overlap.
std::optional<MotionPoint> MotionContacts::overlap_between(const MotionPoint& from, const MotionPoint& to,
                                                           const PointAt& point_at) {
  std::optional<MotionPoint> found;
  for (const Candidate& c : survey_.minima) {
    if (inspector_.held(to.state, c)) continue;
    const auto opening = [&](const MotionPoint& p) { return opening_of(model_, c, p); };
    const Opening before = opening(from), after = opening(to);
    if (!(before.rate < 0 && after.rate > 0)) continue;
    const double fall = std::max(-before.rate, after.rate) * (to.time - from.time);
    if (std::min(before.gap, after.gap) > fall) continue;
    const auto closing = [&](const MotionPoint& p) { return -opening(p).rate; };
    const MotionPoint lowest = locate(from, to, point_at, closing, 1e-6 * std::min(-before.rate, after.rate));
    if (opening(lowest).gap < -touching_ && (!found || lowest.time < found->time)) found = lowest;
  }
  return found;
}

/// Whether the time of a change is known, and not only that it has happened: a minimum of the gap may have appeared
/// beside a contact since the last search and have closed.
bool MotionContacts::is_located(const Change& change) const {
  if (change.kind == Change::Kind::ends) return false;
  return std::all_of(change.candidates.begin(), change.candidates.end(), [&](const Candidate& c) {
    return opening_of(model_, c, change.point).gap > -kLateOverlap * touching_;
  });
}

/// The change found by a search at `to`. If its time cannot be located from there, searches between `from` and `to`
/// locate it.
MotionContacts::Change MotionContacts::first_seen(const MotionPoint& from, const MotionPoint& to,
                                                  const PointAt& point_at) {
  Change change = look(from, to, point_at);
  MotionPoint before = from, after = to, middle;
  for (int k = 0; k < kMaxHalvings && change.kind != Change::Kind::none && !is_located(change); ++k) {
    const double t = 0.5 * (before.time + after.time);
    if (!(t > before.time && t < after.time) || !point_at(t, middle)) break;
    (looks_well(middle) ? before : after) = middle;
    if (Change nearer = look(before, after, point_at); nearer.kind != Change::Kind::none) change = std::move(nearer);
  }
  return change;
}

MotionContacts::Change MotionContacts::look(const MotionPoint& from, const MotionPoint& to, const PointAt& point_at) {
  Findings findings;
  inspector_.inspect(to.state, findings);
  Change first;
  const auto consider = [&](Change change) {
    if (first.kind == Change::Kind::none || change.point.time < first.point.time) first = std::move(change);
  };
  if (!findings.final() && !findings.not_minimal.empty())
    return {Change::Kind::splits, findings.not_minimal.front(), findings.beside, to, {}};
  for (const Candidate& c : findings.overlapping) {
    if (c.minimum.gap > -allowed_overlap(to.state, c)) continue;
    const auto gap = [&](const MotionPoint& p) { return opening_of(model_, c, p).gap; };
    const double shift = gap(from) > 0 ? 0 : touching_;  // a contact just opened may have a negative gap by rounding
    const auto value = [&](const MotionPoint& p) { return gap(p) + shift; };
    Change closes{Change::Kind::closes, 0, {c}, locate(from, to, point_at, value, 1e-3 * touching_), {}};
    if (!is_located(closes)) return closes;  // earlier than any other known change
    consider(std::move(closes));
  }
  // Contacts that close at the same time close together.
  for (const Candidate& c : findings.overlapping)
    if (first.kind == Change::Kind::closes && opening_of(model_, c, first.point).gap < touching_)
      first.candidates.push_back(c);
  for (const int i : findings.pulling) {
    const double shift = from.state.contacts[at(i)].force > 0 ? 0 : kPullTolerance;
    const double scale = model_.scales.force;
    const auto value = [&](const MotionPoint& p) { return p.state.contacts[at(i)].force / scale + shift; };
    consider({Change::Kind::opens, i, {}, locate(from, to, point_at, value, 1e-3 * kPullTolerance), {}});
  }
  if (first.kind != Change::Kind::none) return first;
  if (!findings.merged.empty()) return {Change::Kind::merges, findings.merged.front().second, {}, to, {}};
  std::string why;
  if (findings.final())
    why = findings.doubtful    ? "the contact touches " + findings.where
          : findings.over_edge ? "contact " + findings.where + " runs over the edge of its surface"
                               : "surfaces overlap: " + findings.where;
  if (why.empty()) return {};
  return {Change::Kind::ends, 0, {}, to, fmt::format("{} at {:.9g} s", why, to.time)};
}

bool MotionContacts::apply(const Change& change, MotionPoint& point, std::vector<PathEvent>& events, std::string& why) {
  point = change.point;
  book_.state = point.state;
  if (change.candidates.empty()) return settle(point, change.contact, events, why);
  if (change.kind == Change::Kind::splits) {
    const ActiveContact& gone = point.state.contacts[at(change.contact)];
    events.push_back(event_of(PathEvent::Kind::contact_lost, point,
                              fmt::format("{}.{}", model_.pairs[at(gone.pair)].name, gone.number)));
    book_.state.contacts.erase(book_.state.contacts.begin() + change.contact);
  }
  for (const Candidate& c : change.candidates) {
    if (inspector_.held(book_.state, c)) continue;
    solver_.close(book_, c);
    const ActiveContact& added = book_.state.contacts.back();
    events.push_back(event_of(PathEvent::Kind::contact_gained, point,
                              fmt::format("{}.{}", model_.pairs[at(added.pair)].name, added.number)));
  }
  point.state.contacts = book_.state.contacts;
  return settle(point, -1, events, why);
}

bool MotionContacts::settle(MotionPoint& point, std::vector<PathEvent>& events, std::string& why) {
  return settle(point, -1, events, why);
}

bool MotionContacts::settle(MotionPoint& point, int leaves, std::vector<PathEvent>& events, std::string& why) {
  const std::vector<ActiveContact> before = point.state.contacts;
  for (MotionWatch& watch : watches_) watch.clearance = 0;
  if (before.size() > kMaxContactsAtOnce) {
    why = fmt::format("more than {} contacts at once at {:.9g} s", kMaxContactsAtOnce, point.time);
    return false;
  }
  if ((leaves < 0 && !settle_speeds(model_, equations_, touching_, point)) ||
      !settle_forces(model_, equations_, point, leaves)) {
    why = fmt::format("no active set is possible at {:.9g} s", point.time);
    return false;
  }
  note(before, point, events);
  return true;
}

/// Events for opened contacts, which are followed from here on.
void MotionContacts::note(const std::vector<ActiveContact>& before, const MotionPoint& point,
                          std::vector<PathEvent>& events) {
  for (const ActiveContact& c : before) {
    if (contains(point.state, c)) continue;
    events.push_back(
        event_of(PathEvent::Kind::contact_lost, point, fmt::format("{}.{}", model_.pairs[at(c.pair)].name, c.number)));
    book_.open.push_back({c.pair, c.number, c.geometry, 0});
  }
  book_.state = point.state;
}

}  // namespace genu
