#include "genu/judge/motion.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/judge/curve.h"
#include "genu/judge/tolerances.h"

namespace genu::judge {

MotionRows::MotionRows(const Subject& subject, const ResultsFile& table, const std::vector<std::size_t>& rows)
    : subject_(subject), table_(table), rows_(rows) {
  if (!subject.scene.dynamics) return;
  for (const std::size_t row : rows_) at_.push_back(read(row));
}

MotionRows::At MotionRows::read(std::size_t index) const {
  const Scene& scene = subject_.scene;
  const Row row{&table_, index};
  At out;
  out.time = row("time_s");
  out.q = coordinates_in(scene, row);
  for (int j = 0; j < static_cast<int>(scene.joints.size()); ++j) {
    auto& rates = out.rates.emplace_back();
    for (int i = 0; i < 6; ++i)
      if (scene.joints[at(j)].leaves(i))
        rates[at(i)] =
            row(coordinate_name(scene, {j, i}) + (i < 3 ? "_velocity_deg_s" : "_velocity_mm_s")) * column_unit({j, i});
  }
  const std::vector<Pose> poses = poses_at(scene, out.q);
  const std::vector<Motion> motions = velocities(out.q, out.rates, poses);
  for (std::size_t b = 0; b < poses.size(); ++b) {
    const Mass& mass = subject_.masses[b];
    Momentum m;
    m.centre = poses[b] * mass.centre;
    m.linear = mass.m * (motions[b].v + motions[b].w.cross(m.centre - poses[b].p));
    m.angular = poses[b].R * mass.inertia * poses[b].R.transpose() * motions[b].w;
    out.momentum.push_back(m);
  }
  out.pieces = pieces_in(row, out);
  return out;
}

std::vector<Motion> MotionRows::velocities(const Coordinates& q, const Coordinates& rates,
                                           const std::vector<Pose>& poses) const {
  const Scene& scene = subject_.scene;
  std::vector<Motion> out(poses.size());
  for (int j = 0; j < static_cast<int>(scene.joints.size()); ++j) {
    const std::vector<bool> carried = carried_by(scene, j);
    const Vec3& origin = poses[at(scene.joints[at(j)].child)].p;
    for (int i = 0; i < 6; ++i) {
      if (!scene.joints[at(j)].leaves(i) || rates[at(j)][at(i)] == 0) continue;
      const Motion m = motion_of(scene, q, poses, j, i);
      for (std::size_t b = 0; b < poses.size(); ++b) {
        if (!carried[b]) continue;
        out[b].v += rates[at(j)][at(i)] * (m.v + m.w.cross(poses[b].p - origin));
        out[b].w += rates[at(j)][at(i)] * m.w;
      }
    }
  }
  return out;
}

std::vector<int> MotionRows::pieces_in(const Row& row, const At& here) const {
  const Scene& scene = subject_.scene;
  std::vector<int> pieces;
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i) {
    const LigamentDef& def = scene.ligaments[i];
    const double strain = row(def.name + ".strain"), transition = def.number("transition_strain");
    pieces.push_back((row(def.name + ".force_N") == 0 ? 1 : 0) + (transition > 0 && strain > transition ? 2 : 0));
  }
  for (std::size_t j = 0; j < scene.joints.size(); ++j)
    if (const auto& limits = scene.joints[j].limits)
      pieces.push_back(here.q[j][0] > limits->upper ? 1 : here.q[j][0] < limits->lower ? -1 : 0);
  for (const ContactDef& pair : scene.contacts) {
    pieces.push_back(row(pair.name + ".force_N") > 0 ? 1 : 0);
    for (int k = 1; row.has(fmt::format("{}.{}.force_N", pair.name, k)); ++k)
      pieces.push_back(row(fmt::format("{}.{}.force_N", pair.name, k)) > 0 ? 1 : 0);
  }
  return pieces;
}

bool MotionRows::knot_between(double from, double to) const {
  const auto has_knot = [&](const ScaleDef& own) {
    const ScaleDef& scale = own.kind == ScaleDef::Kind::feedback ? *own.target : own;
    std::vector<double> knots = {scale.start, scale.start + scale.rise};
    if (scale.kind == ScaleDef::Kind::over_time) {
      knots.clear();
      for (const auto& point : scale.table) knots.push_back(point.first);
    }
    return scale.kind != ScaleDef::Kind::over_coordinate &&
           std::any_of(knots.begin(), knots.end(), [&](double t) { return t > from && t < to; });
  };
  for (const LoadDef& load : subject_.scene.loads)
    if (load.scale && has_knot(*load.scale)) return true;
  for (const auto& drive : subject_.scene.dynamics->prescribe)
    if (has_knot(drive.course)) return true;
  return false;
}

bool MotionRows::smooth(std::size_t k, std::size_t reach, double& interval) const {
  if (k < reach || k + reach >= at_.size()) return false;
  interval = (at_[k + reach].time - at_[k - reach].time) / static_cast<double>(2 * reach);
  if (!(interval > 0) || knot_between(at_[k - reach].time, at_[k + reach].time)) return false;
  for (std::size_t i = k - reach; i < k + reach; ++i)
    if (std::abs(at_[i + 1].time - at_[i].time - interval) > 1e-6 * interval || at_[i + 1].pieces != at_[i].pieces)
      return false;
  return true;
}

/// Of order 6 from rows k - 3 ... k + 3. Its difference from order 4 bounds the error of order 4. Neither detects an
/// oscillation from row to row; the sixth difference does.
template <typename Value, typename Get>
Value MotionRows::slope_at(std::size_t k, double h, Get get, double& error) const {
  error = 0;
  Value slope = get(at_[k]);
  for (const std::size_t middle : {k - 1, k + 1, k}) {
    const auto across = [&](std::size_t i) -> Value { return get(at_[middle + i]) - get(at_[middle - i]); };
    const Value a = across(1), b = across(2), c = across(3);
    const Value fourth = (8 * a - b) / (12 * h);
    const auto both = [&](std::size_t i) -> Value { return get(at_[middle + i]) + get(at_[middle - i]); };
    const Value swing = (both(3) - 6 * both(2) + 15 * both(1) - 10 * both(0)) * (M_PI / (64 * h));
    slope = (45 * a - 9 * b + c) / (60 * h);
    if constexpr (std::is_same_v<Value, double>)
      error = std::max(error, 4 * std::abs(slope - fourth) + std::abs(swing));
    else
      error = std::max(error, 4 * (slope - fourth).norm() + swing.norm());
  }
  return slope;
}

void MotionRows::check_courses(const PoseCase& pose, const At& here) const {
  for (const auto& drive : subject_.scene.dynamics->prescribe) {
    const double unit = column_unit(drive.quantity);
    const double asked = scale_at(drive.course, here.time), found = value_of(subject_.scene, here.q, drive.quantity);
    pose.out->expect("prescribed values", "deg, mm", std::abs(found - asked) / unit,
                     (pose.length_tolerance() + 1e-9 * (1 + std::abs(asked))) / unit,
                     column_of(subject_.scene, drive.quantity));
  }
}

/// Rates must be the slopes of the coordinates, as far as the rows resolve them.
void MotionRows::check_rates(std::size_t k, const PoseCase& pose, Findings& out) const {
  double h = 0;
  if (!smooth(k, kDifferenceRows, h))
    return out.skip(
        "rates, and balance with inertia, within four rows of an end, a nonsmooth point of a load or course, or a "
        "change of contacts or of a ligament's formula");
  const Scene& scene = subject_.scene;
  for (int j = 0; j < static_cast<int>(scene.joints.size()); ++j)
    for (int i = 0; i < 6; ++i) {
      if (!scene.joints[at(j)].leaves(i)) continue;
      double error = 0;
      const double found = slope_at<double>(
          k, h, [&](const At& x) { return x.q[at(j)][at(i)]; }, error);
      const double rate = at_[k].rates[at(j)][at(i)], unit = column_unit({j, i});
      const double known =
          (scene.dynamics->tolerance + 1e-14) * (std::abs(at_[k].q[at(j)][at(i)]) + (i < 3 ? 1 : subject_.size));
      double quickest = 0;
      for (std::size_t r = k - kDifferenceRows; r <= k + kDifferenceRows; ++r)
        quickest = std::max(quickest, std::abs(at_[r].rates[at(j)][at(i)]));
      if (error > kResolvedRate * quickest + known / h) {
        out.skip("rates where the rows are too far apart to tell them");
        continue;
      }
      pose.out->expect("rates of coordinates", "deg/s, mm/s", std::abs(found - rate) / unit,
                       (error + known / h + 1e-9 * std::abs(rate)) / unit, coordinate_name(scene, {j, i}));
    }
}

/// Error of the rates estimated from differences of the coordinates. An oscillation faster than the rows looks slow
/// there, and the rates alone do not show it; accelerations miss about 2 pi / h times as much.
std::vector<Motion> MotionRows::missed(std::size_t k, double h) const {
  Coordinates missed = at_[k].rates;
  for (std::size_t j = 0; j < missed.size(); ++j)
    for (std::size_t i = 0; i < 6; ++i) {
      double error = 0;
      if (subject_.scene.joints[j].leaves(static_cast<int>(i)))
        missed[j][i] -= slope_at<double>(
            k, h, [&](const At& x) { return x.q[j][i]; }, error);
    }
  return velocities(at_[k].q, missed, poses_at(subject_.scene, at_[k].q));
}

/// Adds -d(momentum)/dt of each body. False where the rows are too far apart for it.
bool MotionRows::add_inertia(std::size_t k, PoseForces& forces, double& unsure_force, double& unsure_moment) const {
  double h = 0;
  if (!smooth(k, kDifferenceRows, h)) return false;
  const Scene& scene = subject_.scene;
  double size = 0;
  for (const Force& f : forces.forces) size += f.force.norm();
  // Rates are known to about the motion's tolerance, relative and in sizes per second.
  const std::vector<Motion> hidden = missed(k, h);
  const double noise = 10 * scene.dynamics->tolerance / h;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (scene.bodies[b].fixed) continue;
    const Mass& mass = subject_.masses[b];
    const Momentum& here = at_[k].momentum[b];
    double error = 0, error_turn = 0;
    const Vec3 force = slope_at<Vec3>(
        k, h, [&](const At& x) { return x.momentum[b].linear; }, error);
    const Vec3 moment = slope_at<Vec3>(
        k, h, [&](const At& x) { return x.momentum[b].angular; }, error_turn);
    forces.forces.push_back({static_cast<int>(b), here.centre, -force, -moment});
    const double quick = 2 * M_PI / h, turned = quick * hidden[b].w.norm();
    const double own = error + noise * (here.linear.norm() + mass.m * subject_.size) +
                       mass.m * (quick * hidden[b].v.norm() + turned * mass.centre.norm());
    unsure_force += own;
    unsure_moment += error_turn + mass.inertia.norm() * turned + noise * (here.angular.norm() + mass.inertia.norm()) +
                     own * subject_.size;
    size += force.norm();
  }
  return unsure_force <= kResolvedRate * size;
}

void MotionRows::judge(std::size_t k, bool surfaces, Findings& out) const {
  const Row row{&table_, rows_[k]};
  PoseCase pose;
  if (!begin_pose(subject_, row, out, pose)) return;
  const At& here = at_[k];
  const std::vector<Motion> motions = velocities(here.q, here.rates, pose.poses);
  PoseForces forces;
  check_row(pose);
  check_prescribed(pose);
  check_courses(pose, here);
  const DynamicsDef& dynamics = *subject_.scene.dynamics;
  const double asked = std::min(row("increment") * dynamics.output_interval, dynamics.duration);
  out.expect("times", "s", std::abs(here.time - asked), 1e-9 * dynamics.output_interval + 1e-12 * asked, "");
  check_rates(k, pose, out);
  check_ligaments(pose, &motions, forces);
  check_bushings(pose, &motions, forces);
  add_loads(pose, forces);
  for (int j = 0; j < static_cast<int>(subject_.scene.joints.size()); ++j) {
    const JointDef& joint = subject_.scene.joints[at(j)];
    if (!(joint.damping > 0)) continue;
    const double moment = -joint.damping * here.rates[at(j)][0];
    out.expect("joint dampers", "N m", std::abs(row(joint.name + ".damper_Nm") - moment), 1e-9 * (1 + std::abs(moment)),
               joint.name);
    forces.generalised.push_back({{j, 0}, moment});
  }
  check_contacts(pose, forces);
  if (surfaces) check_gaps(pose);
  check_layers(pose, surfaces, forces);
  double unsure_force = 0, unsure_moment = 0;
  double h = 0;
  if (add_inertia(k, forces, unsure_force, unsure_moment))
    check_balance(pose, forces, unsure_force, unsure_moment);
  else if (smooth(k, kDifferenceRows, h))
    out.skip("balance with inertia where the rows are too far apart to tell accelerations");
}

}  // namespace genu::judge
