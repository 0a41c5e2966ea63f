#include "genu/equilibrium/contact_inspection.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/contact/elastic_layer.h"
#include "genu/core/decompositions.h"
#include "genu/equilibrium/tolerances.h"

namespace genu {
namespace {

void add_distinct(std::vector<Candidate>& list, const Candidate& candidate, double same) {
  const bool known = std::any_of(list.begin(), list.end(), [&](const Candidate& k) {
    return k.pair == candidate.pair && same_place(k.minimum.contact, candidate.minimum.contact, same);
  });
  if (!known) list.push_back(candidate);
}

}  // namespace

double least_curvature(const JointModel& model, const State& state, const ActiveContact& contact) {
  const auto& pair = model.pairs[at(contact.pair)];
  const Mat2 curvature =
      relative_curvature(state.poses[at(pair.body_a)], state.poses[at(pair.body_b)], contact.geometry);
  return symmetric_eigen(Mat2(0.5 * (curvature + curvature.transpose()))).values[0];
}

bool same_place(const ContactGeometry& x, const ContactGeometry& y, double distance) {
  return (x.a.p - y.a.p).norm() < distance && (x.b.p - y.b.p).norm() < distance;
}

ContactInspector::ContactInspector(const JointModel& model, ContactField& field)
    : model_(&model), field_(&field), gap_tolerance_(1e-12 * model.scales.length) {
  for (const Pose& pose : model.reference_poses)
    gap_tolerance_ = std::max(gap_tolerance_, kGapRounding * (model.scales.length + pose.p.norm()));
}

bool ContactInspector::held(const State& state, const Candidate& candidate) const {
  return std::any_of(state.contacts.begin(), state.contacts.end(), [&](const ActiveContact& c) {
    return c.pair == candidate.pair && same_place(c.geometry, candidate.minimum.contact, same_contact());
  });
}

void ContactInspector::inspect(const State& state, Findings& out) {
  out = {};
  inspect_held(state, out);
  look_for_merged(state, out);
  look_everywhere(state, out);
  if (!model_->layers.empty()) look_for_buried(state, out);
  if (field_->any_doubtful()) look_for_doubt(state, out);
  for (const Candidate& c : out.overlapping) out.worst = std::min(out.worst, c.minimum.gap / model_->scales.length);
  std::stable_sort(out.overlapping.begin(), out.overlapping.end(),
                   [](const Candidate& x, const Candidate& y) { return x.minimum.gap < y.minimum.gap; });
}

void ContactInspector::look_for_buried(const State& state, Findings& out) {
  const auto buried = field_->buried(state);
  if (!buried) return;
  const auto& layer = model_->layers[at(buried->layer)];
  // A soft layer may be compressed deeper than its search depth somewhere and still carry its load; the report states
  // the depth. A layer without load here would wrongly count as free.
  ElasticLayer::Memory memory;
  LayerWrench pressed;
  layer.layer->evaluate(state.poses[at(layer.body_a)], state.poses[at(layer.body_b)], memory, pressed,
                        state.layer_level(at(buried->layer)));
  if (pressed.load > 0) return;
  out.deep_overlap = true;
  out.worst = std::min(out.worst, -buried->depth / model_->scales.length);
  out.where = fmt::format("{} by {:.3f} mm, deeper than its search_depth of {:.3g} mm", layer.name, 1e3 * buried->depth,
                          1e3 * layer.search_depth);
}

void ContactInspector::look_for_doubt(const State& state, Findings& out) {
  // Where a flaw was cut out of a surface, the finding is the flaw and not the edge.
  beyond_edge_.clear();
  for (const Candidate& c : survey_.edges)
    if (c.minimum.gap < -gap_tolerance_ && !held(state, c)) beyond_edge_.push_back(c);
  const DoubtfulPlace* place = field_->doubtful(state, beyond_edge_);
  if (place == nullptr) return;
  out.doubtful = true;
  out.where = place->what;
}

void ContactInspector::inspect_forces(const State& state, Findings& out) const {
  for (int i = 0; i < static_cast<int>(state.contacts.size()); ++i) {
    const ActiveContact& contact = state.contacts[at(i)];
    const double scaled = contact.force / model_->scales.force;
    out.worst = std::min(out.worst, scaled);
    if (scaled < -kPullTolerance) out.pulling.push_back(i);
    if (field_->edge_distance(contact.pair, contact.geometry) < 0) {
      out.over_edge = true;
      out.where = fmt::format("{}.{}", model_->pairs[at(contact.pair)].name, contact.number);
    }
  }
  std::sort(out.pulling.begin(), out.pulling.end(),
            [&](int i, int j) { return state.contacts[at(i)].force < state.contacts[at(j)].force; });
}

void ContactInspector::inspect_held(const State& state, Findings& out) {
  inspect_forces(state, out);
  for (int i = 0; i < static_cast<int>(state.contacts.size()); ++i) look_beside(state, i, out);
}

/// Two contacts that have merged share one force in any proportion. One of them is removed.
void ContactInspector::look_for_merged(const State& state, Findings& out) const {
  const double one = 1e-3 * same_contact();
  for (int i = 0; i < static_cast<int>(state.contacts.size()); ++i)
    for (int j = i + 1; j < static_cast<int>(state.contacts.size()); ++j) {
      const ActiveContact &a = state.contacts[at(i)], &b = state.contacts[at(j)];
      if (a.pair != b.pair || !same_place(a.geometry, b.geometry, one)) continue;
      out.merged.emplace_back(i, j);
      out.worst = std::min(out.worst, -kPullTolerance);
    }
}

double ContactInspector::margin_of_contact(const State& state, Findings& found) {
  if (!found.not_minimal.empty()) {
    Findings here;
    inspect_held(state, here);
    return here.not_minimal.empty() && here.overlapping.empty() ? 1 : -1;
  }
  if (!found.pulling.empty()) {
    double least = std::numeric_limits<double>::infinity();
    for (const int i : found.pulling) least = std::min(least, state.contacts[at(i)].force);
    return least / model_->scales.force + kPullTolerance;
  }
  Candidate& place = found.overlapping.front();
  const auto descent = field_->follow(state, place.pair, place.minimum.contact);
  if (!descent || !descent->settled) return std::numeric_limits<double>::quiet_NaN();
  place.minimum = descent->minimum;
  return (place.minimum.gap + gap_tolerance_) / model_->scales.length;
}

void ContactInspector::look_beside(const State& state, int i, Findings& out) {
  const ActiveContact& contact = state.contacts[at(i)];
  const double least = least_curvature(*model_, state, contact);
  const double spacing = field_->spacing();
  if (least > kSplittingCurvature / spacing) return;
  beside_.clear();
  for (const double radius : kProbeRadii)
    field_->probe_around(state, contact.pair, contact.geometry, radius * spacing, kValleyCurvature / spacing, beside_);
  bool lower = false;
  for (const LocalMinimum& m : beside_) {
    if (!(m.gap < -gap_tolerance_) || same_place(m.contact, contact.geometry, same_contact())) continue;
    const Candidate candidate{contact.pair, m};
    lower = true;
    if (least < 0)
      out.beside.push_back(candidate);
    else if (!held(state, candidate))
      out.overlapping.push_back(candidate);
  }
  // Flat to rounding (a plane on a plane) counts as a minimum. A saddle counts only if a point beside it lies lower.
  if (least < 0 && lower) out.not_minimal.push_back(i);
}

void ContactInspector::look_everywhere(const State& state, Findings& out) {
  field_->survey(state, survey_);
  std::vector<double> explained(model_->pairs.size(), 0.0);
  for (const Candidate& c : survey_.minima) {
    explained[at(c.pair)] = std::min(explained[at(c.pair)], c.minimum.gap);
    if (held(state, c)) continue;
    out.worst = std::min(out.worst, c.minimum.gap / model_->scales.length);
    if (c.minimum.gap < -gap_tolerance_) add_distinct(out.overlapping, c, same_contact());
  }
  for (const Candidate& c : survey_.edges) {
    if (!(c.minimum.gap < -gap_tolerance_) || held(state, c)) continue;
    explained[at(c.pair)] = std::min(explained[at(c.pair)], c.minimum.gap);
    out.worst = std::min(out.worst, c.minimum.gap / model_->scales.length);
    if (std::isfinite(field_->edge_distance(c.pair, c.minimum.contact))) {
      out.over_edge = true;
      out.where = model_->pairs[at(c.pair)].name;
    } else {  // no edge there: the descent could not leave the overlap
      out.deep_overlap = true;
      out.where = fmt::format("{} by {:.3g} mm", model_->pairs[at(c.pair)].name, -1e3 * c.minimum.gap);
    }
  }
  for (std::size_t pair = 0; pair < survey_.smallest_gap.size(); ++pair) {
    if (survey_.smallest_gap[pair] >= explained[pair] - kUnexplainedOverlap * model_->scales.length) continue;
    out.deep_overlap = true;
    out.worst = std::min(out.worst, survey_.smallest_gap[pair] / model_->scales.length);
    out.where = fmt::format("{} by {:.3f} mm", model_->pairs[pair].name, -1e3 * survey_.smallest_gap[pair]);
  }
}

std::vector<Candidate> ContactInspector::touching(const State& state, Touching which, double within) const {
  // Along a valley (a cylinder on a plane) one contact stands for all that is pressed.
  const auto is_a_place = [&](const Candidate& c) {
    const auto of_pair = [&](const ActiveContact& held) { return held.pair == c.pair; };
    if (which == Touching::all && std::none_of(state.contacts.begin(), state.contacts.end(), of_pair)) return true;
    return least_curvature(*model_, state, {c.pair, 0, c.minimum.contact, 0}) > kSplittingCurvature / field_->spacing();
  };
  std::vector<Candidate> out;
  for (const Candidate& c : survey_.minima)
    if (c.minimum.gap <= std::max(kTouchingTolerances * gap_tolerance_, within) && !held(state, c) && is_a_place(c))
      add_distinct(out, c, same_contact());
  return out;
}

Certificate ContactInspector::certify(const State& state, double residual) const {
  Certificate c;
  c.residual = residual;
  c.smallest_force = c.smallest_gap = c.edge_distance = std::numeric_limits<double>::infinity();
  c.blocking = static_cast<int>(touching(state, Touching::all, residual * model_->scales.length).size());
  c.touching = c.blocking == 0 ? 0 : static_cast<int>(touching(state).size());
  for (const double gap : survey_.smallest_gap) c.smallest_gap = std::min(c.smallest_gap, gap);
  for (const ActiveContact& contact : state.contacts) {
    const auto& pair = model_->pairs[at(contact.pair)];
    c.smallest_force = std::min(c.smallest_force, contact.force);
    c.least_opposed = std::max(c.least_opposed, (state.poses[at(pair.body_a)].R * contact.geometry.a.n)
                                                    .dot(state.poses[at(pair.body_b)].R * contact.geometry.b.n));
    c.edge_distance = std::min(c.edge_distance, field_->edge_distance(contact.pair, contact.geometry));
  }
  return c;
}

}  // namespace genu
