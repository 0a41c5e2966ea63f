// Names of events in files and tables.
#include "genu/equilibrium/path_event.h"

namespace genu {

bool PathEvent::begins_branch() const { return rows_before > 0 && (kind == Kind::snapped || kind == Kind::jump); }

const char* to_string(PathEvent::Kind kind) {
  switch (kind) {
    case PathEvent::Kind::contact_gained:
      return "contact_gained";
    case PathEvent::Kind::contact_lost:
      return "contact_lost";
    case PathEvent::Kind::taut:
      return "taut";
    case PathEvent::Kind::slack:
      return "slack";
    case PathEvent::Kind::transition:
      return "transition";
    case PathEvent::Kind::held:
      return "held";
    case PathEvent::Kind::wraps:
      return "wraps";
    case PathEvent::Kind::unwraps:
      return "unwraps";
    case PathEvent::Kind::wrap_side:
      return "wrap_side";
    case PathEvent::Kind::slips_off:
      return "slips_off";
    case PathEvent::Kind::lifts_off:
      return "lifts_off";
    case PathEvent::Kind::jump:
      return "jump";
    case PathEvent::Kind::stepped_over:
      return "stepped_over";
    case PathEvent::Kind::over_edge:
      return "over_edge";
    case PathEvent::Kind::overlap:
      return "overlap";
    case PathEvent::Kind::flawed_mesh:
      return "flawed_mesh";
    case PathEvent::Kind::turns_back:
      return "turns_back";
    case PathEvent::Kind::limit_point:
      return "limit_point";
    case PathEvent::Kind::bifurcation:
      return "bifurcation";
    case PathEvent::Kind::reaction_turns:
      return "reaction_turns";
    case PathEvent::Kind::closed:
      return "closed";
    case PathEvent::Kind::snaps:
      return "snaps";
    case PathEvent::Kind::snapped:
      return "snapped";
    case PathEvent::Kind::new_branch:
      return "new_branch";
    case PathEvent::Kind::flutter:
      return "flutter";
    case PathEvent::Kind::stability_changed:
      return "stability_changed";
    case PathEvent::Kind::stopped:
      return "stopped";
  }
  return "";
}

PathEvent::Kind end_of(const Findings& findings) {
  if (findings.slips_off) return PathEvent::Kind::slips_off;
  if (findings.lifts_off) return PathEvent::Kind::lifts_off;
  if (findings.doubtful) return PathEvent::Kind::flawed_mesh;
  return findings.over_edge ? PathEvent::Kind::over_edge : PathEvent::Kind::overlap;
}

}  // namespace genu
