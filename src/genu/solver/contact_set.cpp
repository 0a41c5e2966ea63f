#include "genu/solver/contact_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "genu/solver/compliant_seed.h"

namespace genu {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kChanges = 24;  // of the contact set at one pose: more is chatter
// Below this relative curvature (1/m) a contact may be about to split: look around it, the samples may miss its twin.
constexpr double kNearSplit = 3;
constexpr double kProbeRadii[] = {0.3e-3, 0.8e-3, 1.6e-3, 3e-3};  // m
// A held contact and a refined minimum closer than this are the same one.
constexpr double kSameContact = 2e-6;  // m
// Samples overlap by at most this (m) beyond the deepest refined minimum, or something else is wrong.
constexpr double kUnexplained = 1e-5;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

bool same_place(const ContactGeometry& x, const ContactGeometry& y, double distance) {
  return (x.a.p - y.a.p).norm() < distance && (x.b.p - y.b.p).norm() < distance;
}

std::string contact_label(const JointModel& model, const ActiveContact& contact) {
  return fmt::format("{}.{}", model.pairs[at(contact.pair)].name, contact.number);
}

/// A contact set as a sorted list of (pair, number), to notice when one comes back.
std::vector<std::pair<int, int>> signature(const State& state) {
  std::vector<std::pair<int, int>> s;
  for (const ActiveContact& c : state.contacts) s.emplace_back(c.pair, c.number);
  std::sort(s.begin(), s.end());
  return s;
}

}  // namespace

const char* to_string(PoseStatus status) {
  switch (status) {
    case PoseStatus::ok: return "ok";
    case PoseStatus::no_equilibrium: return "no_equilibrium";
    case PoseStatus::over_edge: return "over_edge";
    case PoseStatus::overlap: return "overlap";
    case PoseStatus::chatter: return "chatter";
    case PoseStatus::overconstrained: return "overconstrained";
    case PoseStatus::undetermined: return "undetermined";
  }
  return "";
}

ContactSetSolver::ContactSetSolver(const JointModel& model, ContactField& field, const NewtonOptions& options)
    : model_(&model), field_(&field), options_(options), gap_tolerance_(1e-12 * model.scales.length), newton_(model) {
  constexpr double kRounding = 32 * std::numeric_limits<double>::epsilon();
  for (const Pose& pose : model.reference_poses)
    gap_tolerance_ = std::max(gap_tolerance_, kRounding * (model.scales.length + pose.p.norm()));
}

int ContactSetSolver::contact_limit(const Target& target) const {
  return std::max(0, 6 * model_->moving_count - 1 - static_cast<int>(target.prescribed.size()));
}

bool ContactSetSolver::held(const State& state, const Candidate& candidate) const {
  return std::any_of(state.contacts.begin(), state.contacts.end(), [&](const ActiveContact& c) {
    return c.pair == candidate.pair && same_place(c.geometry, candidate.minimum.contact, kSameContact);
  });
}

void ContactSetSolver::inspect_contacts(const State& state, Findings& out) {
  std::vector<LocalMinimum> found;
  for (int i = 0; i < static_cast<int>(state.contacts.size()); ++i) {
    const ActiveContact& contact = state.contacts[at(i)];
    const double scaled = contact.force / model_->scales.force;
    out.worst = std::min(out.worst, scaled);
    if (scaled < -kForceTolerance) out.pulling.push_back(i);
    if (field_->edge_distance(contact.pair, contact.geometry) < 0) {
      out.over_edge = true;
      out.where = contact_label(*model_, contact);
    }
    const auto& pair = model_->pairs[at(contact.pair)];
    const Mat2 curvature = relative_curvature(state.poses[at(pair.body_a)], state.poses[at(pair.body_b)], contact.geometry);
    const double least = Eigen::SelfAdjointEigenSolver<Mat2>(0.5 * (curvature + curvature.transpose())).eigenvalues()[0];
    if (least > kNearSplit) continue;
    found.clear();
    for (const double radius : kProbeRadii) field_->probe_around(state, contact.pair, contact.geometry, radius, found);
    bool lower = false;
    for (const LocalMinimum& m : found) {
      if (!(m.gap < -gap_tolerance_) || same_place(m.contact, contact.geometry, kSameContact)) continue;
      const Candidate candidate{contact.pair, m};
      lower = true;
      if (least < 0) out.beside.push_back(candidate);
      else if (!held(state, candidate)) out.overlapping.push_back(candidate);
    }
    // Flat to rounding (a plane on a plane) is a minimum; a saddle is one only if something beside it lies lower.
    if (least < 0 && lower) out.not_minimal.push_back(i);
  }
  std::sort(out.pulling.begin(), out.pulling.end(),
            [&](int i, int j) { return state.contacts[at(i)].force < state.contacts[at(j)].force; });
}

void ContactSetSolver::inspect(const State& state, Findings& out) {
  out = {};
  inspect_contacts(state, out);
  field_->survey(state, survey_);
  std::vector<double> explained(model_->pairs.size(), 0.0);
  auto add = [&](const Candidate& c) {
    const auto known = [&](const Candidate& k) {
      return k.pair == c.pair && same_place(k.minimum.contact, c.minimum.contact, kSameContact);
    };
    if (std::none_of(out.overlapping.begin(), out.overlapping.end(), known)) out.overlapping.push_back(c);
  };
  for (const Candidate& c : survey_.minima) {
    explained[at(c.pair)] = std::min(explained[at(c.pair)], c.minimum.gap);
    if (held(state, c)) continue;
    out.worst = std::min(out.worst, c.minimum.gap / model_->scales.length);
    if (c.minimum.gap < -gap_tolerance_) add(c);
  }
  for (const Candidate& c : out.overlapping) out.worst = std::min(out.worst, c.minimum.gap / model_->scales.length);
  for (const Candidate& c : survey_.edges) {
    if (!(c.minimum.gap < -gap_tolerance_) || held(state, c)) continue;
    explained[at(c.pair)] = std::min(explained[at(c.pair)], c.minimum.gap);
    out.worst = std::min(out.worst, c.minimum.gap / model_->scales.length);
    out.over_edge = true;
    out.where = model_->pairs[at(c.pair)].name;
  }
  for (std::size_t pair = 0; pair < survey_.smallest_gap.size(); ++pair) {
    if (survey_.smallest_gap[pair] >= explained[pair] - kUnexplained) continue;
    out.deep_overlap = true;
    out.worst = std::min(out.worst, survey_.smallest_gap[pair] / model_->scales.length);
    out.where = fmt::format("{} by {:.3f} mm", model_->pairs[pair].name, -1e3 * survey_.smallest_gap[pair]);
  }
  std::stable_sort(out.overlapping.begin(), out.overlapping.end(),
                   [](const Candidate& x, const Candidate& y) { return x.minimum.gap < y.minimum.gap; });
}

PoseReport ContactSetSolver::judge(const State& state, const NewtonReport& newton, const Findings& findings) {
  PoseReport report;
  report.newton = newton;
  report.iterations = newton.iterations;
  Certificate& c = report.certificate;
  c.residual = newton.residual;
  c.smallest_force = kInfinity;
  c.smallest_gap = kInfinity;
  c.edge_distance = kInfinity;
  for (const double gap : survey_.smallest_gap) c.smallest_gap = std::min(c.smallest_gap, gap);
  for (const ActiveContact& contact : state.contacts) {
    const auto& pair = model_->pairs[at(contact.pair)];
    c.smallest_force = std::min(c.smallest_force, contact.force);
    c.least_opposed = std::max(c.least_opposed, (state.poses[at(pair.body_a)].R * contact.geometry.a.n)
                                                    .dot(state.poses[at(pair.body_b)].R * contact.geometry.b.n));
    c.edge_distance = std::min(c.edge_distance, field_->edge_distance(contact.pair, contact.geometry));
    c.smallest_gap = std::min(c.smallest_gap, 0.0);
  }
  report.status = PoseStatus::ok;
  if (c.least_opposed > 0) {
    report.status = PoseStatus::overlap;
    report.why = "a contact presses from the inner side";
  }
  if (findings.over_edge) {
    report.status = PoseStatus::over_edge;
    report.why = "contact " + findings.where + " lies past the edge of its surface";
  } else if (findings.deep_overlap) {
    report.status = PoseStatus::overlap;
    report.why = "surfaces overlap deeply: " + findings.where;
  }
  return report;
}

PoseReport ContactSetSolver::solve_held(Balanced& pose, const Target& target, Findings& findings) {
  State state = pose.state;
  const NewtonReport newton = newton_.solve(state, target, options_);
  if (!newton.converged()) {
    PoseReport report;
    report.newton = newton;
    report.iterations = newton.iterations;
    report.why = to_string(newton.outcome);
    return report;
  }
  inspect(state, findings);
  pose.state = std::move(state);
  return judge(pose.state, newton, findings);
}

void ContactSetSolver::close(Balanced& pose, const Candidate& candidate) const {
  constexpr double kSameOpen = 1e-4;  // m: an open contact is followed by descent and lands where the survey does
  ActiveContact contact{candidate.pair, 0, candidate.minimum.contact, 0};
  for (auto it = pose.open.begin(); it != pose.open.end(); ++it) {
    if (it->pair != candidate.pair || !same_place(it->geometry, contact.geometry, kSameOpen)) continue;
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

void ContactSetSolver::release(Balanced& pose, int contact) const {
  const ActiveContact& c = pose.state.contacts[at(contact)];
  pose.open.push_back({c.pair, c.number, c.geometry, 0});
  pose.state.contacts.erase(pose.state.contacts.begin() + contact);
}

void ContactSetSolver::follow_open(Balanced& pose) {
  std::vector<OpenContact> still;
  for (OpenContact open : pose.open) {
    const auto descent = field_->follow(pose.state, open.pair, open.geometry);
    if (!descent || !descent->settled || field_->edge_distance(open.pair, descent->minimum.contact) < 0) continue;
    const Candidate candidate{open.pair, descent->minimum};
    const bool merged = held(pose.state, candidate) ||
                        std::any_of(still.begin(), still.end(), [&](const OpenContact& o) {
                          return o.pair == open.pair && same_place(o.geometry, descent->minimum.contact, kSameContact);
                        });
    if (merged) continue;
    open.geometry = descent->minimum.contact;
    open.gap = descent->minimum.gap;
    still.push_back(open);
  }
  pose.open = std::move(still);
}

bool ContactSetSolver::change(Balanced& pose, const Target& target, const Findings& findings) const {
  State& state = pose.state;
  if (!findings.not_minimal.empty()) {
    for (auto it = findings.not_minimal.rbegin(); it != findings.not_minimal.rend(); ++it) release(pose, *it);
    for (const Candidate& c : findings.beside)
      if (!held(state, c) && static_cast<int>(state.contacts.size()) < contact_limit(target)) close(pose, c);
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

PoseReport ContactSetSolver::settle(Balanced& pose, const Target& target) {
  Balanced trial = pose;
  PoseReport report;
  std::set<std::vector<std::pair<int, int>>> seen;
  int iterations = 0;
  for (int k = 0; k < kChanges; ++k) {
    Findings findings;
    report = solve_held(trial, target, findings);
    report.iterations = iterations += report.iterations;
    if (!report.newton.converged()) return report;
    if (findings.none()) {
      if (report.status != PoseStatus::ok) return report;
      follow_open(trial);
      pose = std::move(trial);
      return report;
    }
    seen.insert(signature(trial.state));
    if (!change(trial, target, findings)) {
      if (report.status == PoseStatus::ok) report.status = PoseStatus::overconstrained;
      return report;
    }
    if (seen.count(signature(trial.state)) > 0) break;
  }
  report.status = PoseStatus::chatter;
  report.why = "no set of contacts satisfies all conditions: the search comes back to one it has left";
  if (static_cast<int>(trial.state.contacts.size()) >= contact_limit(target)) {
    report.status = PoseStatus::overconstrained;
    report.why = "more contacts are needed than the prescribed coordinates leave room for";
  }
  return report;
}

void ContactSetSolver::close_touching(Balanced& pose, const Target& target, double below) {
  field_->survey(pose.state, survey_);
  std::vector<Candidate> minima = survey_.minima;
  std::stable_sort(minima.begin(), minima.end(),
                   [](const Candidate& x, const Candidate& y) { return x.minimum.gap < y.minimum.gap; });
  for (const Candidate& c : minima)
    if (c.minimum.gap < below && static_cast<int>(pose.state.contacts.size()) < contact_limit(target)) close(pose, c);
}

PoseReport ContactSetSolver::settle_from_seed(Balanced& pose, const Target& target) {
  Balanced trial = pose;
  for (const ActiveContact& c : trial.state.contacts) trial.open.push_back({c.pair, c.number, c.geometry, 0});
  const SeedReport seed = compliant_seed(*model_, *field_, target, trial.state);
  PoseReport report;
  if (!seed.balanced) {
    report.iterations = seed.iterations;
    report.why = "no balanced pose was found even on an elastic foundation";
    return report;
  }
  follow_open(trial);
  close_touching(trial, target, 0);
  report = settle(trial, target);
  report.iterations += seed.iterations;
  if (report.status == PoseStatus::ok) pose = std::move(trial);
  return report;
}

PoseReport ContactSetSolver::settle_cold(Balanced& pose, const Target& target) {
  Balanced trial = pose;
  constexpr double kTouching = 5e-5;  // m
  close_touching(trial, target, kTouching);
  PoseReport report = settle(trial, target);
  if (report.status == PoseStatus::ok) {
    pose = std::move(trial);
    return report;
  }
  const int iterations = report.iterations;
  report = settle_from_seed(pose, target);
  report.iterations += iterations;
  return report;
}

}  // namespace genu
