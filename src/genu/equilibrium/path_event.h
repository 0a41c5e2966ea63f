// Something that happens between two rows of a path: a contact gained, a ligament that becomes taut, a limit point.
#pragma once

#include <string>
#include <vector>

#include "genu/equilibrium/contact_inspection.h"
#include "genu/model/step_plan.h"

namespace genu {

/// Something that happened between rows, located on the path.
struct PathEvent {
  enum class Kind {
    contact_gained,
    contact_lost,
    taut,
    slack,
    transition,  ///< a ligament passes another break of its law
    held,        ///< a ligament stays at a jump of its law, with a force between those of the two sides
    jump,        ///< no equilibrium beyond that is near: the force of a ligament drops
    stepped_over,
    over_edge,
    overlap,
    flawed_mesh,
    turns_back,         ///< a limit point that ends the path: no equilibrium lies beyond what is prescribed there
    limit_point,        ///< the same, passed by arc length
    bifurcation,        ///< the smallest stiffness passes 0, and another path branches off
    reaction_turns,     ///< the reaction of what is driven is largest or smallest: a limit point if it were the load
    stability_changed,  ///< the smallest stiffness changes its sign
    closed,             ///< the path is back where it started
    snaps,              ///< the equilibrium ends, the next one is a jump away, and the path ends here
    snapped,            ///< the same, but the path goes on there
    flutter,
    stopped
  };
  Kind kind = Kind::stopped;
  int step = 0;  ///< 0 on the way from the reference pose (or the last step's end) to a step's start
  double t = 0;
  Target target;                              ///< where: prescribed coordinates and load factors
  std::string what;                           ///< e.g. "medial.2"
  std::vector<JointValues> coordinates = {};  ///< of every joint, where the pose is known
  int rows_before = 0;                        ///< how many poses had been handed over when it happened
};
const char* to_string(PathEvent::Kind kind);
/// What ends a path where findings are final().
PathEvent::Kind end_of(const Findings& findings);

}  // namespace genu
