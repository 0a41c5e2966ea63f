#include "genu/appraise/overload.h"

#include <algorithm>

#include "genu/equilibrium/active_set.h"

namespace genu {

double bearable_loads(const Prepared& prepared, ContactField& field, const NewtonOptions& options) {
  if (prepared.model.layers.empty() || prepared.steps.empty()) return 0;
  const Target all = prepared.steps.front().target(0);
  if (std::all_of(all.load_factors.begin(), all.load_factors.end(), [](double f) { return f == 0; })) return 0;
  ActiveSetSolver solver(prepared.model, field, options);
  for (const double part : {0.3, 0.1, 0.03, 0.01}) {
    Target lighter = all;
    for (double& factor : lighter.load_factors) factor *= part;
    Balanced pose;
    pose.state = start_state(prepared.model);
    pose.last_number.assign(prepared.model.pairs.size(), 0);
    if (solver.settle_cold(pose, lighter).status == PoseStatus::ok) return part;
  }
  return 0;
}

}  // namespace genu
