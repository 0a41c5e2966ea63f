#include "genu/solver/uniqueness.h"

#include "genu/contact/elastic_layer.h"
#include "genu/solver/idle_share.h"
#include "genu/solver/one_way.h"

namespace genu {

bool judge_uniqueness(ContactSetSolver& solver, PosePoint& point) {
  const JointModel& model = solver.model();
  if (model.safeguards.lacks(Safeguard::uniqueness)) return true;
  constexpr double kSingular = 1e-13;  // reciprocal condition
  const NewtonReport& newton = point.report.newton;
  look_one_way(model, point.pose.state, point.target, solver.newton().linearization().layer_loads, point.stability);
  share_with_idle(solver, point.target, point.report.certificate.touching > 0, point.pose, point.stability);
  const bool one_way = point.stability.one_way && point.stability.verdict == Stability::Verdict::neutral;
  const bool motion =
      one_way || (point.stability.neutral.cols() > 0 && (!newton.full_rank || newton.rcond < kSingular));
  if (!motion && point.stability.redundant.empty()) return true;
  point.undetermined = find_undetermined(model, point.pose.state, point.target, point.stability);
  point.report.status = PoseStatus::undetermined;
  point.report.why = one_way  ? "a motion costs no force, at least one way: the pose is one of many"
                     : motion ? "a motion costs no force: the pose is one of many"
                              : "the same motion is held twice: how the force is shared is not determined";
  return false;
}

}  // namespace genu
