// Something that happens between two rows of a path: a contact gained, a ligament that becomes taut, a limit point.
#pragma once

#include <string>
#include <vector>

#include "genu/equilibrium/contact_inspection.h"
#include "genu/model/step_plan.h"

namespace genu {

/// An event between two rows, located on the path.
struct PathEvent {
  enum class Kind {
    contact_gained,
    contact_lost,
    taut,
    slack,
    transition,  ///< a ligament passes another break of its law
    held,        ///< a ligament stays at a jump of its law; its force is between those of the two sides
    wraps,       ///< a ligament or cable begins to touch a surface on its way
    unwraps,     ///< it leaves that surface
    wrap_side,   ///< it is found on another side of that surface
    slips_off,   ///< its way round that surface is no shortest one any more
    lifts_off,   ///< it would leave that surface between two places where it touches it
    jump,        ///< no equilibrium is near beyond this: the force of a ligament drops
    stepped_over,
    over_edge,
    overlap,
    flawed_mesh,
    turns_back,         ///< a limit point that ends the path: no equilibrium exists beyond this prescribed value
    limit_point,        ///< a limit point passed by arc length
    bifurcation,        ///< the smallest stiffness passes 0 and another path branches off
    reaction_turns,     ///< the reaction of the driven coordinate has an extremum: a limit point if it were the load
    stability_changed,  ///< the smallest stiffness changes sign
    closed,             ///< the path has returned to its start
    snaps,              ///< the equilibrium ends, the next one is a jump away, and the path ends here
    snapped,            ///< the same, and the path continues there
    new_branch,         ///< after `snapped`: the pose where the joint has come to rest
    flutter,
    stopped
  };
  Kind kind = Kind::stopped;
  int step = 0;  ///< 0: on the way from the reference pose (or the last step's end) to a step's start
  double t = 0;
  Target target;                              ///< prescribed coordinates and load factors there
  std::string what;                           ///< e.g. "medial.2"
  std::vector<JointValues> coordinates = {};  ///< of every joint, where the pose is known
  int rows_before = 0;                        ///< number of poses handed over before it

  /// Whether no path connects the row before with the next one (PosePoint::branch). Across a window that is stepped
  /// over the pose beyond is near, and of the same position.
  bool begins_branch() const;
};
const char* to_string(PathEvent::Kind kind);
/// The event that ends a path where findings are final().
PathEvent::Kind end_of(const Findings& findings);

}  // namespace genu
