#include "genu/results/moment_arm_columns.h"

#include "genu/core/units.h"
#include "genu/model/generalised_forces.h"
#include "genu/model/ligament_pieces.h"
#include "genu/results/columns.h"

namespace genu {

std::string moment_arm_column(const PlacedScene& scene, const std::string& path, const CoordinateRef& c) {
  return path + ".moment_arm." + coordinate_name(scene, c) + (c.index < 3 ? "_mm" : "");
}

void add_moment_arm_columns(const PlacedScene& scene, const JointModel& model, ResultTable& table) {
  for_each_path(model, [&](const LigamentPath&, const std::string& name) {
    for (const CoordinateRef& c : scene.moment_arms) table.add_column(moment_arm_column(scene, name, c));
  });
}

void set_moment_arm_columns(const PlacedScene& scene, const JointModel& model, const State& state, ResultTable& table) {
  if (scene.moment_arms.empty()) return;
  std::vector<std::string> names;
  MatX pulls(6 * model.moving_count, 0);
  for_each_path(model, [&](const LigamentPath& path, const std::string& name) {
    names.push_back(name);
    pulls.conservativeResize(Eigen::NoChange, pulls.cols() + 1);
    pulls.rightCols<1>() = -path.length_gradient(state.poses, model.moving_count, state.wraps);
  });
  const auto arms = on_coordinates(model, state, pulls);
  if (!arms) return;
  for (std::size_t k = 0; k < names.size(); ++k)
    for (const CoordinateRef& c : scene.moment_arms)
      table.set(moment_arm_column(scene, names[k], c),
                (c.index < 3 ? to::kMillimetre : 1.0) * (*arms)(6 * c.joint + c.index, static_cast<Eigen::Index>(k)));
}

}  // namespace genu
