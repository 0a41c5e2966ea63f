#include "genu/equilibrium/edge_at_start.h"

namespace genu {

std::string contact_past_edge(const JointModel& model, ContactField& field, const State& start) {
  for (int pair = 0; pair < static_cast<int>(model.pairs.size()); ++pair)
    if (field.smallest_gap(start, pair) > 0 && !field.nearest(start, pair))
      return "contact " + model.pairs[at(pair)].name + " would lie past the edge of a surface at the start";
  return {};
}

}  // namespace genu
