#include "genu/equilibrium/state_difference.h"

#include <algorithm>

#include <fmt/format.h>

#include "genu/equilibrium/piece_changes.h"
#include "genu/equilibrium/tolerances.h"
#include "genu/model/twist.h"

namespace genu {
namespace {

double translation(const Pose& a, const Pose& b) { return (b.p - a.p).norm(); }
double rotation(const Pose& a, const Pose& b) { return log_rotation(b.R * a.R.transpose()).norm(); }

double largest_in_parent(const JointModel& model, const State& a, const State& b) {
  double out = 0;
  for (const JointModel::Joint& joint : model.joints) {
    const Pose before = a.poses[at(joint.parent)].inverse() * a.poses[at(joint.child)];
    const Pose after = b.poses[at(joint.parent)].inverse() * b.poses[at(joint.child)];
    out = std::max(out, translation(before, after) / model.scales.length + rotation(before, after));
  }
  return out;
}

double largest_in_parent(const JointModel& model, const State& state, const VecX& twist) {
  double out = 0;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const JointModel::Joint& joint = model.joints[j];
    const Vec12 both = twist_of_pair(model, static_cast<int>(j), twist);
    const Vec3 arm = state.poses[at(joint.child)].p - state.poses[at(joint.parent)].p, turn = both.segment<3>(3);
    const Vec3 v = both.segment<3>(6) - both.head<3>() - turn.cross(arm);
    out = std::max(out, v.norm() / model.scales.length + (both.tail<3>() - turn).norm());
  }
  return out;
}

}  // namespace

double speed(const JointModel& model, const State& state, const VecX& twist) {
  if (model.moving_count >= kManyBodies) return largest_in_parent(model, state, twist);
  double sum = 0;
  for (Eigen::Index i = 0; i < twist.size(); i += 6)
    sum += twist.segment<3>(i).norm() / model.scales.length + twist.segment<3>(i + 3).norm();
  return sum;
}

double distance(const JointModel& model, const State& a, const State& b) {
  if (model.moving_count >= kManyBodies) return largest_in_parent(model, a, b);
  double sum = 0;
  for (std::size_t i = 0; i < a.poses.size(); ++i)
    sum += translation(a.poses[i], b.poses[i]) / model.scales.length + rotation(a.poses[i], b.poses[i]);
  return sum;
}

std::pair<double, double> largest_motion(const State& from, const State& to) {
  std::pair<double, double> out{0, 0};
  for (std::size_t i = 0; i < from.poses.size(); ++i) {
    out.first = std::max(out.first, translation(from.poses[i], to.poses[i]));
    out.second = std::max(out.second, rotation(from.poses[i], to.poses[i]));
  }
  return out;
}

std::vector<std::pair<PathEvent::Kind, std::string>> changes(const JointModel& model, const State& before,
                                                             const State& after) {
  std::vector<std::pair<PathEvent::Kind, std::string>> out;
  const auto add = [&](const State& from, const State& to, PathEvent::Kind kind) {
    for (const ActiveContact& c : to.contacts)
      if (!contains(from, c))
        out.emplace_back(kind, fmt::format("{}.{}", model.pairs[static_cast<std::size_t>(c.pair)].name, c.number));
  };
  add(before, after, PathEvent::Kind::contact_gained);
  add(after, before, PathEvent::Kind::contact_lost);
  for (auto& event : piece_events(model, before, after)) out.push_back(std::move(event));
  return out;
}

}  // namespace genu
