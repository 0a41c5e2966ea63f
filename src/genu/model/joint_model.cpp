#include "genu/model/joint_model.h"

namespace genu {
Vec3 joint_centre(const JointModel& model) {
  Vec3 sum = Vec3::Zero();
  for (const auto& l : model.ligaments)
    sum += model.reference_poses[at(l.path.from().body)] * l.path.from().p +
           model.reference_poses[at(l.path.to().body)] * l.path.to().p;
  return model.ligaments.empty() ? sum : Vec3(sum / (2.0 * static_cast<double>(model.ligaments.size())));
}

double quantity_value(const JointModel& model, const std::vector<JointValues>& coordinates,
                      const QuantityRef& quantity) {
  double value = 0;
  for_terms(model, quantity,
            [&](const CoordinateRef& c, double factor) { value += factor * coordinates[at(c.joint)][at(c.index)]; });
  return value;
}

std::vector<Pose> poses_from_coordinates(const JointModel& model, const std::vector<JointValues>& coordinates) {
  std::vector<Pose> poses(model.bodies.size());
  std::vector<bool> placed(model.bodies.size());
  for (std::size_t i = 0; i < model.bodies.size(); ++i) placed[i] = model.bodies[i].moving < 0;
  // Parents before children. The scene has no cycles, so every sweep places at least one body.
  for (std::size_t sweep = 0; sweep < model.joints.size(); ++sweep) {
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      const auto& joint = model.joints[j];
      if (!placed[at(joint.parent)] || placed[at(joint.child)]) continue;
      poses[at(joint.child)] = poses[at(joint.parent)] * joint.coordinates.pose_from(coordinates[j]);
      placed[at(joint.child)] = true;
    }
  }
  return poses;
}

}  // namespace genu
