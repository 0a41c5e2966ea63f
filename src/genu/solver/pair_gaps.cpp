#include "genu/solver/pair_gaps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace genu {
std::vector<double> pair_gaps(const State& state, const std::vector<OpenContact>& open, const JointModel& model,
                              ContactField& field) {
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
      if (c.pair == pair) gap = std::min(gap, c.gap);
    if (!held && !std::isfinite(gap)) gap = field.smallest_gap(state, pair);
  }
  return gaps;
}

}  // namespace genu
