// Loads, weights and joint springs.
#include <algorithm>
#include <cmath>

#include "genu/core/units.h"
#include "genu/judge/curve.h"
#include "genu/judge/joints.h"
#include "genu/judge/pose.h"
#include "genu/judge/tolerances.h"
#include "genu/judge/wrapping.h"

namespace genu::judge {
namespace {

/// What is written where the load holds a prescribed coordinate: that the pose balances shows that it is right.
double factor_of(const PoseCase& pose, int load) {
  const StepDef* step = step_of(pose.scene(), pose.row);
  if (step == nullptr) return 1;
  for (const auto& p : step->prescribe)
    if (std::find(p.drivers.begin(), p.drivers.end(), load) != p.drivers.end())
      return pose.row(pose.scene().loads[at(load)].name + ".factor");
  for (const auto& f : step->factors)
    if (f.load == load) return f.from + part_of(*step, pose.row) * (f.to - f.from);
  return 1;
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

}  // namespace

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
    if (load.kind == LoadDef::Kind::cable) {
      const WrittenPath path = written_path(pose, load.name, load.points, load.wraps);
      pose.out->expect("cable lengths", "mm",
                       std::abs(pose.row(load.name + ".length_mm") - to::kMillimetre * path.length),
                       to::kMillimetre * (kFormulaRounding * path.length + pose.rounding + path.unsure), load.name);
      add_pulls(path, factor * load.activation * load.value, out);
      continue;
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
