#include "genu/judge/pose.h"

#include <algorithm>
#include <cmath>

#include "genu/core/units.h"
#include "genu/judge/curve.h"
#include "genu/judge/joints.h"
#include "genu/judge/tolerances.h"

namespace genu::judge {
namespace {

const StepDef* step_of(const Scene& scene, const Row& row) {
  const double step = row("step");
  if (!(step >= 1) || step > static_cast<double>(scene.steps.size())) return nullptr;
  return &scene.steps[static_cast<std::size_t>(step) - 1];
}

/// The position of a row in its step.
double part_of(const StepDef& step, const Row& row) { return row("increment") / step.increments; }

double factor_of(const PoseCase& pose, int load) {
  const StepDef* step = step_of(pose.scene(), pose.row);
  if (step == nullptr) return 1;
  for (const auto& f : step->factors)
    if (f.load == load) return f.from + part_of(*step, pose.row) * (f.to - f.from);
  return 1;
}

}  // namespace

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

void check_ligaments(const PoseCase& pose, const std::vector<Motion>* velocities, PoseForces& forces) {
  const Scene& scene = pose.scene();
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i) {
    const LigamentDef& def = scene.ligaments[i];
    const TensionLaw& law = pose.subject->laws[i];
    const std::vector<Vec3> path = path_of(def, pose.poses);
    const std::vector<int> bodies = bodies_on(def);
    const double length = length_of(path), sure = kFormulaRounding * length + pose.rounding;
    pose.out->expect("ligament lengths", "mm", std::abs(pose.row(def.name + ".length_mm") - to::kMillimetre * length),
                     to::kMillimetre * sure, def.name);
    if (law.slack_length() > 0)
      pose.out->expect("ligament strains", "1", std::abs(pose.row(def.name + ".strain") - law.strain(length)),
                       2 * (1 + std::abs(law.strain(length))) * sure / law.slack_length() + kFormulaRounding, def.name);
    else if (std::isfinite(pose.row(def.name + ".strain")))
      pose.out->expect("ligament strains", "1", std::nan(""), 0, def.name + " has none");
    const double force = pose.row(def.name + ".force_N");
    const double stiffness = law.stiffness(length);
    Tension tension = law.at(length, pose.length_tolerance());
    double unsure = kFormulaRounding * std::abs(tension.high) + 4 * stiffness * sure;
    if (velocities != nullptr && def.damping > 0) {
      double rate = 0;
      for (std::size_t k = 0; k + 1 < path.size(); ++k) {
        const auto velocity = [&](std::size_t at_point) -> Vec3 {
          const int b = bodies[at_point];
          const Motion& m = (*velocities)[at(b)];
          return m.v + m.w.cross(path[at_point] - pose.poses[at(b)].p);
        };
        rate += (path[k + 1] - path[k]).normalized().dot(velocity(k + 1) - velocity(k));
      }
      const bool pushes = def.law == "spring" || law.force_when_slack() > 0;
      const bool slack = !pushes && tension.high <= 0;
      const double damper = slack ? 0 : def.damping * rate;
      tension.low = pushes ? tension.low + damper : std::max(0.0, tension.low + damper);
      tension.high = pushes ? tension.high + damper : std::max(0.0, tension.high + damper);
      if (!slack) unsure += 1e-9 * std::abs(damper);
      if (!pushes && std::abs(length - law.slack_length()) < sure) {  // about to become taut: either side
        tension.low = std::min(tension.low, 0.0);
        tension.high = std::max(tension.high, std::max(0.0, def.damping * rate));
      }
      pose.out->expect("ligament velocities", "mm/s",
                       std::abs(pose.row(def.name + ".velocity_mm_s") - to::kMillimetre * rate),
                       1e-9 * (1 + to::kMillimetre * std::abs(rate)), def.name);
    }
    const double off = std::max({0.0, tension.low - force, force - tension.high});
    pose.out->expect("ligament forces", "N", std::isfinite(force) ? off : force, unsure + 1e-12, def.name);
    // Tension along the path from the table: balance is judged with the written numbers.
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      if (bodies[k] == bodies[k + 1] || !((path[k + 1] - path[k]).norm() > 0)) continue;
      const Vec3 pull = force * (path[k + 1] - path[k]).normalized();
      forces.forces.push_back({bodies[k], path[k], pull, Vec3::Zero()});
      forces.forces.push_back({bodies[k + 1], path[k + 1], -pull, Vec3::Zero()});
    }
  }
}

/// The scale of a load at a row; of two that a time may have, the one nearer to what is written.
double scale_of(const PoseCase& pose, const ScaleDef& scale, double written) {
  const CoordinateRef& c = scale.coordinate;
  const auto q = [&] { return pose.q[at(c.joint)][at(c.index)]; };
  if (scale.kind == ScaleDef::Kind::over_coordinate) return scale_at(scale, q());
  const double time = pose.row.has("time_s") ? pose.row("time_s") : 0;
  if (scale.kind != ScaleDef::Kind::feedback) return scale_at(scale, time);
  const bool angle = c.index < 3;
  const double rate =
      scale.rate_gain == 0
          ? 0
          : pose.row(coordinate_name(pose.scene(), c) + (angle ? "_velocity_deg_s" : "_velocity_mm_s")) *
                column_unit(c);
  const double before = feedback_at(scale, q(), rate, time, -1), after = feedback_at(scale, q(), rate, time, 1);
  return std::abs(before - written) < std::abs(after - written) ? before : after;
}

void add_loads(const PoseCase& pose, PoseForces& out) {
  const Scene& scene = pose.scene();
  for (int k = 0; k < static_cast<int>(scene.loads.size()); ++k) {
    const LoadDef& load = scene.loads[at(k)];
    double factor = factor_of(pose, k);
    if (const double written = pose.row(load.name + ".factor"); std::isfinite(written))
      pose.out->expect("load factors", "1", std::abs(written - factor), (1e-9 + pose.slack) * (1 + std::abs(factor)),
                       load.name);
    if (load.scale) {
      const double written = pose.row(load.name + ".scale"), scale = scale_of(pose, *load.scale, written);
      const double tolerance = load.scale->rate_gain != 0 ? kFeedbackRateTolerance : 1e-9;
      pose.out->expect("load scales", "1", std::abs(written - scale), tolerance * (1 + std::abs(scale)), load.name);
      factor *= scale;
    }
    if (load.kind == LoadDef::Kind::coordinate) {
      out.generalised.push_back({load.coordinate, factor * load.value});
      continue;
    }
    const Pose& X = pose.poses[at(load.body)];
    const Vec3 point = X * load.point;
    if (load.kind == LoadDef::Kind::toward) {
      const Vec3 to = pose.poses[at(load.toward_body)] * load.toward_point;
      if ((to - point).norm() < 1e-9) continue;
      const Vec3 pull = factor * load.activation * load.value * (to - point).normalized();
      out.forces.push_back({load.body, point, pull, Vec3::Zero()});
      out.forces.push_back({load.toward_body, to, -pull, Vec3::Zero()});
      continue;
    }
    const Mat3 R = load.frame == LoadDef::Frame::body ? X.R : Mat3::Identity();
    out.forces.push_back({load.body, point, factor * (R * load.force), factor * (R * load.moment)});
  }
  for (std::size_t b = 0; scene.gravity && b < scene.bodies.size(); ++b) {
    const Mass& mass = pose.subject->masses[b];
    if (scene.bodies[b].fixed || mass.m == 0) continue;
    out.forces.push_back({static_cast<int>(b), pose.poses[b] * mass.centre, mass.m * *scene.gravity, Vec3::Zero()});
  }
  for (int j = 0; j < static_cast<int>(scene.joints.size()); ++j) {
    const JointDef& joint = scene.joints[at(j)];
    if (joint.type != JointDef::Type::revolute) continue;
    const double angle = pose.q[at(j)][0];
    double moment = -joint.stiffness * angle;
    if (joint.limits && angle > joint.limits->upper) moment -= joint.limits->stiffness * (angle - joint.limits->upper);
    if (joint.limits && angle < joint.limits->lower) moment -= joint.limits->stiffness * (angle - joint.limits->lower);
    if (pose.row.has(joint.name + ".spring_Nm"))
      pose.out->expect("joint springs", "N m", std::abs(pose.row(joint.name + ".spring_Nm") - moment),
                       1e-9 * (1 + std::abs(moment)), joint.name);
    out.generalised.push_back({{j, 0}, moment});
  }
}

}  // namespace genu::judge
