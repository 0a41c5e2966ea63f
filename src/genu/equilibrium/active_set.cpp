#include "genu/equilibrium/active_set.h"

#include <algorithm>
#include <limits>
#include <set>

#include "genu/equilibrium/adrift.h"
#include "genu/equilibrium/edge_at_start.h"
#include "genu/equilibrium/force_guess.h"
#include "genu/equilibrium/held_drivers.h"
#include "genu/equilibrium/piece_changes.h"
#include "genu/equilibrium/poses_between.h"
#include "genu/equilibrium/rigid_descent.h"
#include "genu/equilibrium/stiffness_homotopy.h"
#include "genu/equilibrium/tolerances.h"

namespace genu {
namespace {

constexpr int kWrapsFrom = std::numeric_limits<int>::min() / 2;  // apart from pairs and ligaments
constexpr const char* kBehind = "the equilibrium lies behind a surface: the bodies would have to pass through it";
/// A contact set as a sorted list of (pair, number), with the pieces of ligaments' laws; to notice when one comes back.
std::vector<std::pair<int, int>> signature(const State& state) {
  std::vector<std::pair<int, int>> s;
  for (const ActiveContact& c : state.contacts) s.emplace_back(c.pair, c.number);
  for (const LigamentPiece& p : state.pieces)
    if (!p.by_length) s.emplace_back(-1 - p.ligament, 2 * p.piece + p.held);
  for (std::size_t i = 0; i < state.wraps.size(); ++i)
    if (!state.wraps[i].by_length) s.emplace_back(kWrapsFrom - static_cast<int>(i), state.wraps[i].touching);
  std::sort(s.begin(), s.end());
  return s;
}

}  // namespace

ActiveSetSolver::ActiveSetSolver(const JointModel& model, ContactField& field, const NewtonOptions& options)
    : model_(&model), field_(&field), options_(options), newton_(model), inspector_(model, field) {
  // For contact points far from the world's origin, rounding limits the accuracy of a closed gap.
  if (!model.pairs.empty())
    options_.residual_floor = std::max(options_.residual_floor, inspector_.gap_tolerance() / model.scales.length);
  locating_ = options_;
  locating_.residual_tolerance = std::min(options_.residual_tolerance, kLocatingResidual);
}

int ActiveSetSolver::contact_limit(const Target& target) const {
  return std::max(0, 6 * model_->moving_count - static_cast<int>(constraint_count(*model_, target)));
}

PoseReport ActiveSetSolver::solve_held(Balanced& pose, const Target& target, Findings& findings, bool locating) {
  State state = pose.state;
  const NewtonReport newton = newton_.solve(state, target, locating ? locating_ : options_);
  if (!newton.converged()) {
    PoseReport report;
    report.newton = newton;
    report.iterations = newton.iterations;
    report.why = to_string(newton.outcome);
    return report;
  }
  pose.state = std::move(state);
  findings = {};
  inspector_.inspect_forces(pose.state, findings);
  inspect_pieces(*model_, pose.state, findings);
  // Pieces change first, whatever contacts there are: no search for them, and no certificate.
  return findings.left_a_piece() ? judge(newton, findings) : inspect(pose.state, newton, findings);
}

PoseReport ActiveSetSolver::inspect(const State& state, const NewtonReport& newton, Findings& findings) {
  inspector_.inspect(state, findings);
  inspect_pieces(*model_, state, findings);
  PoseReport report = judge(newton, findings);
  report.certificate = inspector_.certify(state, newton.residual);
  if (report.status != PoseStatus::ok || report.certificate.least_opposed <= 0) return report;
  report.status = PoseStatus::overlap;
  report.why = "a contact presses from the inner side";
  return report;
}

std::vector<Candidate> ActiveSetSolver::touching(const State& state, ContactInspector::Touching which, double within) {
  Findings findings;
  inspector_.inspect(state, findings);
  return inspector_.touching(state, which, within);
}

void ActiveSetSolver::close(Balanced& pose, const Candidate& candidate) const {
  // The descent that follows an open contact ends where the survey's descent ends, up to this distance.
  const double same_open = 0.1 * field_->spacing();
  ActiveContact contact{candidate.pair, 0, candidate.minimum.contact, 0};
  for (auto it = pose.open.begin(); it != pose.open.end(); ++it) {
    if (it->pair != candidate.pair || !same_place(it->geometry, contact.geometry, same_open)) continue;
    contact.number = it->number;
    pose.open.erase(it);
    break;
  }
  if (contact.number == 0) {
    pose.last_number.resize(model_->pairs.size(), 0);
    contact.number = ++pose.last_number[at(candidate.pair)];
  }
  pose.state.contacts.push_back(contact);
}

void ActiveSetSolver::release(Balanced& pose, int contact) const {
  const ActiveContact& c = pose.state.contacts[at(contact)];
  pose.open.push_back({c.pair, c.number, c.geometry, 0});
  pose.state.contacts.erase(pose.state.contacts.begin() + contact);
}

void ActiveSetSolver::follow_open(Balanced& pose) {
  std::vector<OpenContact> still;
  for (OpenContact open : pose.open) {
    const auto descent = field_->follow(pose.state, open.pair, open.geometry);
    if (!descent || !descent->settled || field_->edge_distance(open.pair, descent->minimum.contact) < 0) continue;
    const Candidate candidate{open.pair, descent->minimum};
    const bool merged =
        inspector_.held(pose.state, candidate) || std::any_of(still.begin(), still.end(), [&](const OpenContact& o) {
          return o.pair == open.pair && same_place(o.geometry, descent->minimum.contact, inspector_.same_contact());
        });
    if (merged) continue;
    open.geometry = descent->minimum.contact;
    open.gap = descent->minimum.gap;
    still.push_back(open);
  }
  pose.open = std::move(still);
}

bool ActiveSetSolver::change(Balanced& pose, const Target& target, const Findings& findings) const {
  State& state = pose.state;
  if (!findings.merged.empty()) {
    const auto [stays, goes] = findings.merged.front();
    state.contacts[at(stays)].force += state.contacts[at(goes)].force;
    state.contacts.erase(state.contacts.begin() + goes);
    return true;
  }
  if (!findings.not_minimal.empty()) {
    for (auto it = findings.not_minimal.rbegin(); it != findings.not_minimal.rend(); ++it) release(pose, *it);
    for (const Candidate& c : findings.beside)
      if (!inspector_.held(state, c) && static_cast<int>(state.contacts.size()) < contact_limit(target)) close(pose, c);
    return true;
  }
  if (!findings.overlapping.empty()) {
    const Candidate& deepest = findings.overlapping.front();
    if (static_cast<int>(state.contacts.size()) >= contact_limit(target)) {
      if (state.contacts.empty()) return false;
      const auto weakest = std::min_element(state.contacts.begin(), state.contacts.end(),
                                            [](const auto& x, const auto& y) { return x.force < y.force; });
      release(pose, static_cast<int>(weakest - state.contacts.begin()));
    }
    close(pose, deepest);
    return true;
  }
  if (!findings.pulling.empty()) {
    release(pose, findings.pulling.front());
    return true;
  }
  return false;
}

PoseReport ActiveSetSolver::settle(Balanced& pose, const Target& target) {
  Balanced trial = pose;
  follow_lengths(*model_, trial.state);
  PoseReport report;
  std::set<std::vector<std::pair<int, int>>> seen;
  int iterations = 0;
  for (int k = 0; k < kMaxSetChanges; ++k) {
    Findings findings;
    report = solve_held(trial, target, findings);
    report.iterations = iterations += report.iterations;
    const bool solved = report.newton.converged() && (report.newton.full_rank || held_count(trial.state) == 0);
    if (!solved && (let_go(*model_, trial.state) || fix_pieces(*model_, trial.state))) continue;
    if (!report.newton.converged()) return settle_without_one(pose, trial, target, report);
    if (findings.none()) {
      if (report.status != PoseStatus::ok) return report;
      fix_pieces(*model_, trial.state);
      follow_open(trial);
      pose = std::move(trial);
      return report;
    }
    seen.insert(signature(trial.state));
    if (!change_pieces(*model_, findings, trial.state) && !change(trial, target, findings)) {
      if (report.status == PoseStatus::ok) report.status = PoseStatus::overconstrained;
      return report;
    }
    if (seen.count(signature(trial.state)) > 0) break;
  }
  report.status = PoseStatus::chatter;
  report.why = "no active set satisfies all conditions: the search cycles";
  if (const std::string gap = piece_in_doubt(*model_, trial.state); !gap.empty())
    report.why = "no equilibrium on either side of the jump of " + gap;
  if (static_cast<int>(trial.state.contacts.size()) >= contact_limit(target)) {
    report.status = PoseStatus::overconstrained;
    report.why = "more contacts are needed than the free coordinates allow";
  }
  return report;
}

PoseReport ActiveSetSolver::settle_without_one(Balanced& pose, const Balanced& failed, const Target& target,
                                               const PoseReport& failure) {
  // Contacts that exclude each other (the two feet of a stool with prescribed tilt) make the Jacobian singular. One of
  // them must be released before the other can close.
  if (failure.newton.full_rank || failed.state.contacts.size() < 2) return failure;
  int iterations = failure.iterations;
  for (int i = 0; i < static_cast<int>(failed.state.contacts.size()); ++i) {
    Balanced trial = failed;
    release(trial, i);
    Findings findings;
    PoseReport report = solve_held(trial, target, findings);
    report.iterations = iterations += report.iterations;
    if (report.status != PoseStatus::ok || !findings.none()) continue;
    fix_pieces(*model_, trial.state);
    follow_open(trial);
    pose = std::move(trial);
    return report;
  }
  return failure;
}

void ActiveSetSolver::close_touching(Balanced& pose, const Target& target, double below) {
  field_->survey(pose.state, survey_);
  std::vector<Candidate> minima = survey_.minima;
  std::stable_sort(minima.begin(), minima.end(),
                   [](const Candidate& x, const Candidate& y) { return x.minimum.gap < y.minimum.gap; });
  for (const Candidate& c : minima)
    if (c.minimum.gap < below && static_cast<int>(pose.state.contacts.size()) < contact_limit(target)) close(pose, c);
}

PoseReport ActiveSetSolver::settle_or_guess(Balanced& pose, const Target& target) {
  // A contact without force has no stiffness along the surfaces, and Newton's method may diverge: a ball in a cup that
  // is hardly larger has the whole of its stiffness from the force.
  Balanced guessed = pose;
  PoseReport report = settle(pose, target);
  if (report.status != PoseStatus::no_equilibrium || !guess_forces(*model_, target, guessed.state)) return report;
  pose = std::move(guessed);
  PoseReport again = settle(pose, target);
  again.iterations += report.iterations;
  return again;
}

PoseReport ActiveSetSolver::settle_from_seed(Balanced& pose, const Target& target, const SeedWay& way) {
  Balanced trial = pose;
  for (const ActiveContact& c : trial.state.contacts) trial.open.push_back({c.pair, c.number, c.geometry, 0});
  const SeedReport seed = with_held_drivers(*model_, target, trial.state, [&](const Target& held) {
    return way.downhill ? descent_seed(*model_, *field_, held, trial.state, way.stride, options_.cancelled)
                        : stiffness_homotopy(*model_, *field_, held, trial.state, way.stiffer, options_.cancelled);
  });
  PoseReport report;
  if (!seed.balanced) {
    report.iterations = seed.iterations;
    const std::string away = adrift(*model_, *field_, pose.state, seed.ended);
    report.adrift = !away.empty();
    report.why = report.adrift ? away : "no balanced pose was found even on an elastic foundation";
    return report;
  }
  follow_open(trial);
  close_touching(trial, target, 0);
  report = settle_or_guess(trial, target);
  report.iterations += seed.iterations;
  if (report.status == PoseStatus::ok) pose = std::move(trial);
  return report;
}

bool ActiveSetSolver::passes_through(const State& from, const State& to, bool followed) {
  // Newton's method sees only surfaces in contact: from above a thin sheet it may find a pose below. On the straight
  // way between the two poses the bodies then overlap, although they do so at neither end. A body that rolls over
  // another also overlaps on that way, but only a little.
  const double step = 2 * field_->spacing(),
               shallow = followed ? step : std::max(step, kPassingOverlap * model_->scales.length);
  for (int pair = 0; pair < static_cast<int>(model_->pairs.size()); ++pair) {
    const double moved = field_->motion(from, to, pair);
    const int steps = static_cast<int>(std::min<double>(kMaxPassingLooks, std::ceil(moved / step)));
    if (steps <= 1) continue;
    if (followed && moved > kMaxPassingLooks * step) return true;  // too far to be looked at
    const double allowed = std::max(field_->overlap(from, pair), field_->overlap(to, pair)) + shallow;
    State between = from;
    for (int k = 1; k < steps; ++k) {
      poses_between(from, to, static_cast<double>(k) / steps, between);
      if (field_->overlap(between, pair) > allowed) return true;
    }
  }
  return false;
}

PoseReport ActiveSetSolver::settle_downhill(Balanced& pose, const Target& target) {
  Balanced trial = pose;
  for (const ActiveContact& c : trial.state.contacts) trial.open.push_back({c.pair, c.number, c.geometry, 0});
  const RestReport rest = with_held_drivers(*model_, target, trial.state, [&](const Target& held) {
    return slide_to_rest(*model_, *field_, held, trial.state, options_.cancelled);
  });
  PoseReport report;
  report.iterations = rest.steps;
  if (!rest.at_rest) {
    if (rest.over_edge) report.status = PoseStatus::over_edge;
    report.why = rest.over_edge ? "sliding downhill, the joint dislocates over the edge of a surface"
                                : "no pose of rest was found by sliding downhill";
    return report;
  }
  const State slid = trial.state;
  follow_open(trial);
  for (std::size_t k = 0; k < rest.pressing.size(); ++k) {
    close(trial, rest.pressing[k]);
    trial.state.contacts.back().force = rest.forces[k];
  }
  report = settle(trial, target);
  report.iterations += rest.steps;
  if (report.status != PoseStatus::ok) return report;
  if (passes_through(slid, trial.state)) {
    report.status = PoseStatus::overlap;
    report.why = kBehind;
    return report;
  }
  pose = std::move(trial);
  return report;
}

PoseReport ActiveSetSolver::settle_cold(Balanced& pose, const Target& target) {
  Balanced trial = pose;
  close_touching(trial, target, 0.05 * field_->spacing());
  PoseReport report = settle_or_guess(trial, target);
  if (report.status == PoseStatus::ok) {
    if (!passes_through(pose.state, trial.state)) {
      pose = std::move(trial);
      return report;
    }
    report.status = PoseStatus::overlap;
    report.why = kBehind;
  }
  // A contact at a flaw is no reason to stop: the joint may come to rest elsewhere. On a foundation too soft for the
  // forces a body passes through a thin surface, so stiffer ones follow. Where Newton's method wanders, descent
  // converges. Its long steps may leap over a rim that a body would slide into, so short ones come last.
  PoseReport seeded;
  for (const SeedWay& way : {SeedWay{}, SeedWay{.stiffer = 30}, SeedWay{.stiffer = 1000}, SeedWay{.downhill = true},
                             SeedWay{.downhill = true, .stride = Stride::careful}}) {
    trial = pose;
    PoseReport tried = settle_from_seed(trial, target, way);
    tried.iterations += seeded.iterations;
    if (tried.status == PoseStatus::ok && passes_through(pose.state, trial.state))
      tried.status = PoseStatus::overlap, tried.why = kBehind;
    const bool vague = tried.status == PoseStatus::no_equilibrium && !tried.adrift;
    if (way.downhill && (vague || (tried.status != PoseStatus::ok && seeded.status != PoseStatus::no_equilibrium)))
      seeded.iterations = tried.iterations;  // where descent fails, the report of Newton's method says more
    else
      seeded = tried;
    if (tried.status != PoseStatus::ok) continue;
    pose = std::move(trial);
    break;
  }
  seeded.iterations += report.iterations;
  // Of two failures, keep the one that names a cause.
  if (seeded.status == PoseStatus::no_equilibrium && report.status != PoseStatus::no_equilibrium) seeded = report;
  const bool deep = seeded.status == PoseStatus::overlap && seeded.why != kBehind;
  if (const std::string edge = deep ? contact_past_edge(*model_, *field_, pose.state) : ""; !edge.empty())
    seeded.status = PoseStatus::over_edge, seeded.why = edge;
  return seeded;
}

}  // namespace genu
