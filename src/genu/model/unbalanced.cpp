#include "genu/model/unbalanced.h"

#include "genu/model/generalised_forces.h"
#include "genu/model/layer_levels.h"

namespace genu {
Unbalanced unbalanced(const JointModel& model, State state, Target target, Linearization& memory) {
  target.prescribed.clear();
  state.contacts.clear();
  state.multipliers.assign(model.held.size(), 0.0);
  do {
    linearize(model, state, target, memory);
  } while (raise_layer_levels(model, memory, state));
  Unbalanced out;
  out.layer_levels = state.layer_levels;
  out.wrenches.resize(at(model.moving_count));
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const int moving = model.bodies[b].moving;
    if (moving < 0) continue;
    const Mat3 to_body = state.poses[b].R.transpose();
    Vec6& wrench = out.wrenches[at(moving)];
    wrench.head<3>() = -(to_body * memory.wrench.segment<3>(6 * moving));
    wrench.tail<3>() = -(to_body * memory.wrench.segment<3>(6 * moving + 3)) -
                       own_origin(model, static_cast<int>(b)).cross(Vec3(wrench.head<3>()));
  }
  if (const auto forces = on_coordinates(model, state, -memory.wrench)) {
    out.forces.emplace(model.joints.size());
    for (std::size_t j = 0; j < model.joints.size(); ++j)
      for (std::size_t i = 0; i < 6; ++i) (*out.forces)[j][i] = (*forces)(static_cast<Eigen::Index>(6 * j + i), 0);
  }
  return out;
}

}  // namespace genu
