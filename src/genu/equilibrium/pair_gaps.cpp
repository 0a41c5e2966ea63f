#include "genu/equilibrium/pair_gaps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "genu/equilibrium/tolerances.h"

namespace genu {
namespace {

double open_gap(const State& state, int pair, const JointModel& model, ContactField& field,
                std::vector<OpenContact>& open) {
  OpenContact* lowest = nullptr;
  for (OpenContact& c : open)
    if (c.pair == pair && (lowest == nullptr || c.gap < lowest->gap)) lowest = &c;
  const double smallest = field.smallest_gap(state, pair);
  if (lowest == nullptr) return smallest;
  if (!(smallest < lowest->gap - kSampleGapRounding * model.scales.length)) return lowest->gap;
  if (const auto nearest = field.nearest(state, pair)) {
    lowest->geometry = nearest->contact;
    return lowest->gap = nearest->gap;
  }
  std::erase_if(open, [pair](const OpenContact& c) { return c.pair == pair; });
  return smallest;
}

}  // namespace

std::vector<double> pair_gaps(const State& state, const JointModel& model, ContactField& field,
                              std::vector<OpenContact>& open) {
  std::vector<double> gaps(model.pairs.size(), std::numeric_limits<double>::infinity());
  for (int pair = 0; pair < static_cast<int>(gaps.size()); ++pair) {
    double& gap = gaps[at(pair)];
    bool held = false;
    for (const ActiveContact& c : state.contacts) {
      if (c.pair != pair) continue;
      const auto& p = model.pairs[at(pair)];
      const Pose &X_a = state.poses[at(p.body_a)], &X_b = state.poses[at(p.body_b)];
      gap = std::min(gap, (X_a.R * c.geometry.a.n).dot(X_b * c.geometry.b.p - X_a * c.geometry.a.p));
      held = true;
    }
    for (const OpenContact& c : open)
      if (held && c.pair == pair) gap = std::min(gap, c.gap);
    if (!held) gap = open_gap(state, pair, model, field, open);
  }
  return gaps;
}

}  // namespace genu
