#include "genu/equilibrium/uniqueness.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "genu/contact/elastic_layer.h"
#include "genu/equilibrium/self_stress.h"
#include "genu/equilibrium/tolerances.h"
#include "genu/equilibrium/unilateral_stability.h"

namespace genu {
namespace {

/// Whether the Jacobian at the pose is singular within rounding and the pose's residual. Where a motion along a curve
/// has no cost, forces out of balance add a stiffness of their own size. Where the cost is x^p with p > 1, the Jacobian
/// x^(p - 1) is far larger than the residual. The Jacobian is factored here because Newton's last one may be that of
/// the step before.
bool singular_at(const JointModel& model, const State& state, const Target& target,
                 std::shared_ptr<LayerMemories> layers) {
  Linearization at;
  at.layers = std::move(layers);  // they know this pose
  linearize(model, state, target, at);
  NewtonStep step(model);
  if (!step.factor(at, target) || !step.linear().full_rank()) return true;
  return step.linear().rcond() < std::max(kSingularStep, kSingularOfResidual * step.residual(at, target));
}

/// assess_unilateral_stability() with all places that touch without an active contact.
void look_at_what_touches(ActiveSetSolver& solver, const Balanced& pose, const PoseReport& report, const Target& target,
                          const std::vector<double>& layer_loads, Stability& stability) {
  Balanced closed = pose;
  if (report.certificate.blocking > 0)
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
  at.layers = solver.newton().linearization().layers;  // they know this pose
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
  const bool motion = unilateral || (free && singular_at(model, point.pose.state, point.target,
                                                         solver.newton().linearization().layers));
  if (!motion && point.stability.redundant.empty()) return true;
  point.undetermined = find_undetermined(model, point.pose.state, point.target, point.stability);
  point.report.status = PoseStatus::undetermined;
  point.report.why = !point.stability.unknown_why.empty()
                         ? point.stability.unknown_why + ": whether the pose is stable is not known"
                     : unilateral ? "a motion costs no force, at least one way: the equilibrium is not unique"
                     : motion     ? "a motion costs no force: the equilibrium is not unique"
                                  : "the same motion is constrained twice: the forces are statically indeterminate";
  return false;
}

}  // namespace genu
