#include "peers/judge.h"

#include <algorithm>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/model/unbalanced.h"

namespace genu::peers {
namespace {

constexpr const char* kColumns = "{:<9}{:<24}{:>9}{:>11}{:>14}{:>10}{:>10}{:>11}\n";

Mat3 rotation(const JointModel& model, const Coordinates& c) { return model.joints[0].coordinates.pose_from(c).R; }

/// Springs and contact on the femur, but for the moment that holds flexion: it does no work in the other two rotations.
double unbalanced_force(const Prepared& prepared, const FoundPose& found, Linearization& memory) {
  const JointModel& model = prepared.model;
  State state = reference_state(model);
  state.coordinates = {found.coordinates};
  state.poses = poses_from_coordinates(model, state.coordinates);
  const Vec6 missing = unbalanced(model, state, prepared.steps[0].target(0), memory).wrenches[0];
  const Mat3 R = rotation(model, found.coordinates);
  const Eigen::Map<const Vec6> contact(found.contact.data());
  const Vec3 force = contact.head<3>() - R * missing.head<3>();
  const Vec3 moment = contact.tail<3>() - R * missing.tail<3>();
  const Vec3 second = rotation(model, {found.coordinates[0], 0, 0}).col(1), third = R.col(2);
  const double length = model.scales.length;
  return Vec5(force.x(), force.y(), force.z(), moment.dot(second) / length, moment.dot(third) / length).norm();
}

std::string milliseconds(std::vector<double> seconds, std::size_t poses) {
  if (seconds.empty() || poses == 0) return "-";
  const auto middle = seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2);
  std::nth_element(seconds.begin(), middle, seconds.end());
  return fmt::format("{:.3f}", 1e3 * *middle / static_cast<double>(poses));
}

std::string line(const Row& row) {
  Judged most;
  std::size_t failed = 0;
  for (const Judged& pose : row.poses) {
    if (pose.failed) {
      ++failed;
      continue;
    }
    most.unbalanced = std::max(most.unbalanced, pose.unbalanced);
    most.distance = std::max(most.distance, pose.distance);
    most.angle = std::max(most.angle, pose.angle);
  }
  const std::size_t poses = row.poses.size();
  const auto shown = [&](double value) { return failed < poses ? fmt::format("{:.2g}", value) : "-"; };
  return fmt::format(kColumns, row.software, row.contact, row.triangles > 0 ? std::to_string(row.triangles) : "-",
                     milliseconds(row.seconds, poses), shown(most.unbalanced), shown(to::kMillimetre * most.distance),
                     shown(to::kDegree * most.angle), fmt::format("{} of {}", failed, poses));
}

}  // namespace

std::vector<Judged> judge(const Prepared& prepared, const FoundPath& found, const FoundPath& reference) {
  std::vector<Judged> judged(reference.poses.size());
  Linearization memory;
  for (std::size_t k = 0; k < std::min(found.poses.size(), judged.size()); ++k) {
    const FoundPose &pose = found.poses[k], &rigid = reference.poses[k];
    if (!pose.settled || !rigid.settled) continue;
    const Pose a = prepared.model.joints[0].coordinates.pose_from(rigid.coordinates);
    const Pose b = prepared.model.joints[0].coordinates.pose_from(pose.coordinates);
    judged[k].unbalanced = unbalanced_force(prepared, pose, memory);
    judged[k].distance = (Vec3(pose.coordinates.data() + 3) - Vec3(rigid.coordinates.data() + 3)).norm();
    judged[k].angle = log_rotation(a.R.transpose() * b.R).norm();
    judged[k].failed = !(judged[k].unbalanced <= kMostUnbalanced);
  }
  return judged;
}

std::string to_text(const std::vector<Row>& rows) {
  std::string out =
      fmt::format(kColumns, "", "contact", "triangles", "ms a pose", "unbalanced N", "mm", "deg", "failed");
  for (const Row& row : rows) out += line(row);
  return out;
}

}  // namespace genu::peers
