// The status of a pose, from what was found at it.
#include "genu/equilibrium/active_set.h"

namespace genu {

const char* to_string(PoseStatus status) {
  switch (status) {
    case PoseStatus::ok:
      return "ok";
    case PoseStatus::no_equilibrium:
      return "no_equilibrium";
    case PoseStatus::over_edge:
      return "over_edge";
    case PoseStatus::overlap:
      return "overlap";
    case PoseStatus::chatter:
      return "chatter";
    case PoseStatus::overconstrained:
      return "overconstrained";
    case PoseStatus::undetermined:
      return "undetermined";
    case PoseStatus::flawed_mesh:
      return "flawed_mesh";
    case PoseStatus::slips_off:
      return "slips_off";
    case PoseStatus::lifts_off:
      return "lifts_off";
  }
  return "";
}

PoseReport ActiveSetSolver::judge(const NewtonReport& newton, const Findings& findings) {
  PoseReport report;
  report.newton = newton;
  report.iterations = newton.iterations;
  report.status = PoseStatus::ok;
  if (findings.slips_off) {
    report.status = PoseStatus::slips_off;
    report.why = findings.where + " is no shortest way any more: it slips off";
  } else if (findings.lifts_off) {
    report.status = PoseStatus::lifts_off;
    report.why =
        findings.where + ": it would lift off there; name the surface twice in its path for two places of touch";
  } else if (findings.doubtful) {
    report.status = PoseStatus::flawed_mesh;
    report.why = "the contact touches " + findings.where;
  } else if (findings.over_edge) {
    report.status = PoseStatus::over_edge;
    report.why = "contact " + findings.where + " lies past the edge of its surface";
  } else if (findings.deep_overlap) {
    report.status = PoseStatus::overlap;
    report.why = "surfaces overlap deeply: " + findings.where;
  }
  return report;
}

}  // namespace genu
