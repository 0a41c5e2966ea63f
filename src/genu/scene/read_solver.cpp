// [solver]: how exactly poses are solved.
#include <algorithm>

#include <fmt/format.h>

#include "genu/scene/read_parts.h"
#include "genu/scene/tolerances.h"

namespace genu {

void read_solver(ReadContext& context, Section& root) {
  const Item item = root.find("solver");
  if (!is_table(context, item)) return;
  Section section(context, item, "a solver");
  const Item tolerance = section.find("tolerance");
  const auto value = read_number(context, tolerance, positive(plain_rule({})));
  if (value && (*value < kMinSolverTolerance || *value > kMaxSolverTolerance))
    refuse(context, tolerance, Code::out_of_range,
           fmt::format("must be from {:g} to {:g}", kMinSolverTolerance, kMaxSolverTolerance));
  else if (value)
    context.scene.solver.tolerance = std::min(*value, kLoosestSolverTolerance);
  if (value && *value > kLoosestSolverTolerance && *value <= kMaxSolverTolerance && !context.in_motion)
    context.warning(
        tolerance.node->where, Code::no_effect, tolerance.path, literal(*tolerance.node),
        fmt::format("counts as {:g}: contacts and events are decided by poses, and looser ones can lose contacts "
                    "and save no time",
                    kLoosestSolverTolerance));
  section.finish();
  if (context.in_motion)
    context.error(item.node->key_where, Code::no_effect, item.path, {},
                  "is of poses solved step by step; a motion over time has a tolerance of its own in [dynamics]");
}

}  // namespace genu
