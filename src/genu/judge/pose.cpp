#include "genu/judge/pose.h"

#include <algorithm>
#include <cmath>

#include "genu/core/units.h"
#include "genu/judge/tolerances.h"

namespace genu::judge {

const StepDef* step_of(const Scene& scene, const Row& row) {
  const double step = row("step");
  if (!(step >= 1) || step > static_cast<double>(scene.steps.size())) return nullptr;
  return &scene.steps[static_cast<std::size_t>(step) - 1];
}

double part_of(const StepDef& step, const Row& row) { return row("increment") / step.increments; }

bool begin_pose(const Subject& subject, const Row& row, Findings& out, PoseCase& pose) {
  pose.subject = &subject;
  pose.row = row;
  pose.out = &out;
  pose.q = coordinates_in(subject.scene, row);
  double largest = 0;
  for (const auto& joint : pose.q)
    for (const double x : joint) {
      if (!std::isfinite(x)) return out.expect("coordinates are there", "", 1, 0, "a cell is empty"), false;
      largest = std::max(largest, std::abs(x));
    }
  pose.poses = poses_at(subject.scene, pose.q);
  for (const SurfaceDef& s : subject.scene.surfaces) largest = std::max(largest, s.placement.p.norm());
  for (const LigamentDef& l : subject.scene.ligaments)
    largest = std::max({largest, l.from.point.norm(), l.to.point.norm()});
  pose.rounding = 64 * std::numeric_limits<double>::epsilon() * largest;
  const double residual = row("residual");
  const double cap = std::max(kMaxSlack, subject.scene.solver.tolerance);
  pose.slack = kResidualNorms * (std::isfinite(residual) ? std::clamp(residual, 0.0, cap) : 0);
  return true;
}

void check_row(const PoseCase& pose) {
  const Scene& scene = pose.scene();
  const double step = pose.row("step"), increment = pose.row("increment");
  const auto steps = static_cast<double>(std::max<std::size_t>(1, scene.steps.size()));
  const StepDef* def = step_of(scene, pose.row);
  const bool by_arc = def != nullptr && def->arc_length;  // may go backward, also beyond its start
  const double last = def != nullptr ? def->increments : std::numeric_limits<double>::infinity();
  const bool whole = std::floor(step) == step && std::floor(increment) == increment;
  const bool named = step >= 1 && step <= steps && whole && (by_arc || (increment >= 0 && increment <= last));
  bool follows = true;
  const double branch = pose.row("branch");
  if (pose.row.has("branch")) {
    const Row before{pose.row.file, pose.row.index > 0 ? pose.row.index - 1 : 0};
    const double least = pose.row.index > 0 ? before("branch") : 1;
    pose.out->expect("branches are counted", "", std::floor(branch) == branch && branch >= least ? 0 : 1, 0, "branch");
  }
  if (pose.row.index > 0) {
    const Row before{pose.row.file, pose.row.index - 1};
    follows = before("step") < step || (before("step") == step && (by_arc || before("increment") < increment));
  }
  pose.out->expect("rows follow the steps", "", named && follows ? 0 : 1, 0, "step, increment");
  const double residual = pose.row("residual"), most = std::max(kMaxSlack, scene.solver.tolerance);
  if (scene.dynamics) return;
  pose.out->expect("residuals", "1", std::abs(residual), most, residual < 0 ? "below 0" : "");
  const double iterations = pose.row("newton.iterations");
  if (pose.row.has("newton.iterations"))
    pose.out->expect("iterations", "", std::max(0.0, -iterations) + std::abs(iterations - std::round(iterations)), 0,
                     "newton.iterations");
}

void check_prescribed(const PoseCase& pose) {
  const Scene& scene = pose.scene();
  for (int k = 0; k < static_cast<int>(scene.combinations.size()); ++k) {
    const QuantityRef quantity{scene.combinations[at(k)].terms.front().coordinate, k};
    const double unit = column_unit(quantity), value = value_of(scene, pose.q, quantity);
    pose.out->expect("combinations", "deg, mm", std::abs(pose.row(column_of(scene, quantity)) - value / unit),
                     kFormulaRounding * (1 + std::abs(value / unit)), column_of(scene, quantity));
  }
  const StepDef* step = step_of(scene, pose.row);
  if (step == nullptr) return;
  double time = part_of(*step, pose.row) * step->duration;
  for (const StepDef* s = scene.steps.data(); s != step; ++s) time += s->duration;
  if (!step->arc_length)
    pose.out->expect("times", "s", std::abs(pose.row("time_s") - time), kFormulaRounding * (1 + time), "");
  for (const auto& p : step->prescribe) {
    const double unit = column_unit(p.coordinate);
    const double asked = p.from + part_of(*step, pose.row) * (p.to - p.from);
    const double found = value_of(scene, pose.q, p.coordinate);
    const double scale = p.coordinate.is_rotation() ? 1 : pose.subject->size;
    pose.out->expect("prescribed values", "deg, mm", std::abs(found - asked) / unit,
                     ((1e-9 + pose.slack) * scale + kFormulaRounding * std::abs(asked) + pose.rounding) / unit,
                     column_of(scene, p.coordinate));
  }
}

}  // namespace genu::judge
