#include "genu/motion/motion_contacts.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/core/bracket.h"
#include "genu/equilibrium/uniqueness.h"
#include "genu/motion/contact_choice.h"

namespace genu {
namespace {

constexpr int kMostAtOnce = 10;        // contacts among which sets are tried: 2^10 solves of a small system
constexpr double kStepErrors = 10;     // gaps below so many errors of a step are none
constexpr double kTouching = 1e-9;     // of the length scale: what touches at the start
constexpr double kOverlapping = 1e-6;  // of the length scale: what overlaps at the start
constexpr double kOfClearance = 0.9;   // of the gap between them, the same
constexpr double kExplained = 1e-6;    // of the length scale: samples overlap by no more than minima do
constexpr double kMayConform = 3e-3;   // of 1 / spacing: relative curvature below which a contact may be about to split
constexpr double kSteepAcross = 1.2e-2;  // of the same: in a valley others lie along its bottom
constexpr double kHasTwins = 1.2e-2;     // of the same: below, another contact may be born beside one at any step
constexpr double kBeside[] = {0.3, 0.8, 1.6, 3};  // of the spacing: where others are born beside a contact
constexpr double kOfTwins = 1e-3;                 // of `touching_`
constexpr double kLate = 2;  // of `touching_`: an overlap by more was seen too late to tell when it began
constexpr int kMostHalvings = 60;

PathEvent event_of(PathEvent::Kind kind, const MotionPoint& point, std::string what) {
  PathEvent event;
  event.kind = kind;
  event.step = 1;
  event.target.time = point.time;
  event.what = std::move(what);
  event.coordinates = point.state.coordinates;
  return event;
}

/// The gap at a minimum of it that is followed to `point`, m, and how fast it opens, m/s; not numbers where it is lost.
struct Opening {
  double gap = std::nan(""), rate = std::nan("");
};

Opening opening_of(const JointModel& model, const Candidate& minimum, const MotionPoint& point) {
  ActiveContact contact{minimum.pair, 0, minimum.minimum.contact, 0};
  ClosedContact closed;
  if (!evaluate_closed(model, point.state, contact, closed)) return {};
  return {closed.gap, closed.gradient.dot(twist_at(model, contact, point.twist))};
}

/// Where `value`, positive at `from` and negative at `to`, passes 0; `to` where that cannot be told.
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
    why = findings.doubtful    ? "contact leans on " + findings.where
          : findings.over_edge ? findings.where + " lies past the edge of its surface at the start"
                               : "surfaces overlap at the start: " + findings.where;
    return false;
  }
  Survey survey;
  field_.survey(point.state, survey);
  const double length = model_.scales.length;
  book_.state = point.state;
  for (const Candidate& c : survey.minima) {
    if (inspector_.held(book_.state, c) || c.minimum.gap > kTouching * length) continue;
    if (c.minimum.gap < -kOverlapping * length) {
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

/// Whether nothing can touch and open again between two points without a look at the second showing where: what is
/// open moves no farther than a survey sees, or than it is known to be clear.
bool MotionContacts::near(const MotionPoint& from, const MotionPoint& to) {
  for (int k = 0; k < static_cast<int>(model_.pairs.size()); ++k) {
    const double way = watches_[at(k)].way(from, to);
    const bool held = std::any_of(from.state.contacts.begin(), from.state.contacts.end(),
                                  [&](const ActiveContact& c) { return c.pair == k; });
    const double unwatched = held ? watches_[at(k)].unwatched : std::min(watches_[at(k)].unwatched, field_.window());
    if (way <= unwatched) continue;
    if (held || !field_.is_clear(from.state, k, way / kOfClearance)) return false;
  }
  return true;
}

/// Whether nothing that was open at the last look can have closed since, and nothing pulls: no look is needed.
bool MotionContacts::known_clear(const MotionPoint& from, const MotionPoint& to) {
  bool clear = model_.layers.empty();
  for (const ActiveContact& c : to.state.contacts)
    clear = clear && c.force >= -ContactInspector::kForceTolerance * model_.scales.force;
  for (int k = 0; k < static_cast<int>(watches_.size()); ++k) {
    MotionWatch& watch = watches_[at(k)];
    watch.travelled += watch.way(from, to);
    clear = clear && watch.travelled < kOfClearance * watch.clearance;
  }
  return clear && std::none_of(to.state.contacts.begin(), to.state.contacts.end(),
                               [&](const ActiveContact& c) { return born_beside(to.state, c); });
}

/// Whether surfaces overlap beside a contact that hardly bends away, or whether it may be about to split itself.
bool MotionContacts::born_beside(const State& state, const ActiveContact& contact) {
  const double spacing = field_.spacing();
  if (bends_away(model_, state, contact, kHasTwins / spacing)) return false;
  if (!bends_away(model_, state, contact, kMayConform / spacing)) return true;
  beside_.clear();
  for (const double radius : kBeside)
    field_.probe_around(state, contact.pair, contact.geometry, radius * spacing, kSteepAcross / spacing, beside_);
  return std::any_of(beside_.begin(), beside_.end(), [&](const LocalMinimum& m) {
    const Candidate candidate{contact.pair, m};
    return m.gap < -allowed_overlap(state, candidate) && !inspector_.held(state, candidate);
  });
}

/// m: what a minimum of the gap may overlap by without being told. Beside a contact that hardly bends away it is next
/// to nothing: that contact may be about to vanish, and this is then what carries its load.
double MotionContacts::allowed_overlap(const State& state, const Candidate& candidate) const {
  const bool twin = std::any_of(state.contacts.begin(), state.contacts.end(), [&](const ActiveContact& c) {
    return c.pair == candidate.pair && !bends_away(model_, state, c, kHasTwins / field_.spacing());
  });
  return twin ? kOfTwins * touching_ : touching_;
}

/// A survey that finds nothing which the inspector would have to judge; it tells how far everything is from closing.
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
    if (survey_.smallest_gap[k] < explained[k] - kExplained * model_.scales.length) return false;
  for (std::size_t i = 0; i < point.state.contacts.size(); ++i) {
    const ActiveContact& c = point.state.contacts[i];
    if (c.force < 0 || field_.edge_distance(c.pair, c.geometry) < 0) return false;
    const double least = least_curvature(model_, point.state, c), beside = kBeside[3] * field_.spacing();
    if (least < kMayConform / field_.spacing()) return false;
    // Farther away than is looked at beside a contact the gap is about this.
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
    for (int k = 0; k < kMostHalvings && !near(here, next); ++k) {
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

/// Where a gap that the last survey saw, that shrinks at `from` and grows at `to`, is least: the earliest at which
/// surfaces overlap there.
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

/// Whether the moment of a change is known, and not only that it has happened by then: a minimum of the gap may have
/// been born beside a contact since the last look, and have closed.
bool MotionContacts::is_located(const Change& change) const {
  if (change.kind == Change::Kind::ends) return false;
  return std::all_of(change.candidates.begin(), change.candidates.end(),
                     [&](const Candidate& c) { return opening_of(model_, c, change.point).gap > -kLate * touching_; });
}

/// The change that a look at `to` shows; where that was too late to tell its moment, looks between tell it.
MotionContacts::Change MotionContacts::first_seen(const MotionPoint& from, const MotionPoint& to,
                                                  const PointAt& point_at) {
  Change change = look(from, to, point_at);
  MotionPoint before = from, after = to, middle;
  for (int k = 0; k < kMostHalvings && change.kind != Change::Kind::none && !is_located(change); ++k) {
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
    const double shift = gap(from) > 0 ? 0 : touching_;  // one that has just opened may have shrunk by a rounding
    const auto value = [&](const MotionPoint& p) { return gap(p) + shift; };
    Change closes{Change::Kind::closes, 0, {c}, locate(from, to, point_at, value, 1e-3 * touching_), {}};
    if (!is_located(closes)) return closes;  // before anything else, as far as is known
    consider(std::move(closes));
  }
  // What closes at the same moment closes together.
  for (const Candidate& c : findings.overlapping)
    if (first.kind == Change::Kind::closes && opening_of(model_, c, first.point).gap < touching_)
      first.candidates.push_back(c);
  for (const int i : findings.pulling) {
    const double shift = from.state.contacts[at(i)].force > 0 ? 0 : ContactInspector::kForceTolerance;
    const double scale = model_.scales.force;
    const auto value = [&](const MotionPoint& p) { return p.state.contacts[at(i)].force / scale + shift; };
    consider(
        {Change::Kind::opens, i, {}, locate(from, to, point_at, value, 1e-3 * ContactInspector::kForceTolerance), {}});
  }
  if (first.kind != Change::Kind::none) return first;
  if (!findings.merged.empty()) return {Change::Kind::merges, findings.merged.front().second, {}, to, {}};
  std::string why;
  if (findings.final())
    why = findings.doubtful    ? "contact leans on " + findings.where
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
  if (before.size() > kMostAtOnce) {
    why = fmt::format("more than {} contacts at once at {:.9g} s", kMostAtOnce, point.time);
    return false;
  }
  if ((leaves < 0 && !settle_speeds(model_, equations_, touching_, point)) ||
      !settle_forces(model_, equations_, point, leaves)) {
    why = fmt::format("no set of contacts is possible at {:.9g} s", point.time);
    return false;
  }
  note(before, point, events);
  return true;
}

/// Events for what has opened, which is followed from here on.
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
