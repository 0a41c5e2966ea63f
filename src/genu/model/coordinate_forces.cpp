#include "genu/model/coordinate_forces.h"

#include "genu/core/decompositions.h"
#include "genu/model/linearization.h"

namespace genu {

std::optional<MatX> on_coordinates(const JointModel& model, const State& state, const MatX& wrenches) {
  MatX gradients = MatX::Zero(wrenches.rows(), 6 * static_cast<Eigen::Index>(model.joints.size()));
  for (int j = 0; j < static_cast<int>(model.joints.size()); ++j) {
    const auto& joint = model.joints[at(j)];
    const JointPoint point = joint_point(model, state, j);
    if (point.at_gimbal()) return std::nullopt;
    const int parent = model.bodies[at(joint.parent)].moving, child = model.bodies[at(joint.child)].moving;
    for (int i = 0; i < 6; ++i) {
      const JointPoint::Gradient gradient = point.gradient(i);
      if (parent >= 0) gradients.col(6 * j + i).segment<6>(6 * parent) += gradient.head<6>().transpose();
      if (child >= 0) gradients.col(6 * j + i).segment<6>(6 * child) += gradient.tail<6>().transpose();
    }
  }
  return least_squares_solution(gradients, wrenches);
}

}  // namespace genu
