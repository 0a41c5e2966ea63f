#include "genu/equilibrium/uniqueness.h"

#include <algorithm>

#include "genu/contact/elastic_layer.h"
#include "genu/equilibrium/self_stress.h"
#include "genu/equilibrium/unilateral_stability.h"

namespace genu {
namespace {

/// Whether the Jacobian at the pose is as singular as rounding and the pose's own residual allow to tell. Where a
/// motion along a curve costs no force, forces that are not yet quite balanced stiffen it by as much as they are; where
/// it costs x^p with p > 1, the Jacobian there is far larger than the residual: x^(p - 1). The last one that Newton's
/// method has factored may be that of the step before.
bool singular_at(const JointModel& model, const State& state, const Target& target) {
  constexpr double kSingular = 1e-13;  // reciprocal condition
  constexpr double kOfResidual = 100;
  Linearization at;
  linearize(model, state, target, at);
  NewtonStep step(model);
  if (!step.factor(at, target) || !step.linear().full_rank()) return true;
  return step.linear().rcond() < std::max(kSingular, kOfResidual * step.residual(at, target));
}

/// assess_unilateral_stability(), with all that touches and is not held.
void look_at_what_touches(ActiveSetSolver& solver, const Balanced& pose, const PoseReport& report, const Target& target,
                          const std::vector<double>& layer_loads, Stability& stability) {
  Balanced closed = pose;
  if (report.certificate.barring > 0)
    for (const Candidate& c : solver.touching(pose.state, ContactInspector::Touching::all,
                                              report.certificate.residual * solver.model().scales.length))
      solver.close(closed, c);
  const auto first = closed.state.contacts.begin() + static_cast<std::ptrdiff_t>(pose.state.contacts.size());
  assess_unilateral_stability(solver.model(), pose.state, {first, closed.state.contacts.end()}, target, layer_loads,
                              report.certificate.residual, stability);
}

}  // namespace

Stability stability_of(ActiveSetSolver& solver, const Balanced& pose, const PoseReport& report, const Target& target) {
  const JointModel& model = solver.model();
  Linearization at;
  linearize(model, pose.state, target, at);
  Stability out = assess_stability(at, model.scales.length);
  look_at_what_touches(solver, pose, report, target, at.layer_loads, out);
  return out;
}

bool judge_uniqueness(ActiveSetSolver& solver, PosePoint& point) {
  const JointModel& model = solver.model();
  look_at_what_touches(solver, point.pose, point.report, point.target, solver.newton().linearization().layer_loads,
                       point.stability);
  find_self_stress(solver, point.target, point.report.certificate, point.pose, point.stability);
  const bool free = point.stability.neutral.cols() > 0;
  const bool unilateral =
      point.stability.unilateral && (free || point.stability.verdict == Stability::Verdict::neutral);
  const bool motion = unilateral || (free && singular_at(model, point.pose.state, point.target));
  if (!motion && point.stability.redundant.empty()) return true;
  point.undetermined = find_undetermined(model, point.pose.state, point.target, point.stability);
  point.report.status = PoseStatus::undetermined;
  point.report.why = !point.stability.untold.empty()
                         ? point.stability.untold + ": whether the pose is stable is not known"
                     : unilateral ? "a motion costs no force, at least one way: the pose is one of many"
                     : motion     ? "a motion costs no force: the pose is one of many"
                                  : "the same motion is held twice: how the force is shared is not determined";
  return false;
}

}  // namespace genu
