#include "genu/results/bushing_columns.h"

#include <string>

#include "genu/core/units.h"
#include "genu/results/columns.h"

namespace genu {
namespace {

struct Quantity {
  const char *before, *after;
  double shown;  ///< per SI unit
};
constexpr Quantity kDisplacement[] = {{".", "_mm", to::kMillimetre}, {".turn_", "_deg", to::kDegree}};
constexpr Quantity kForces[] = {{".force_", "_N", 1}, {".moment_", "_Nm", 1}};

std::string column(const Bushing& bushing, const Quantity& quantity, std::size_t axis) {
  return bushing.name + quantity.before + kAxisNames[axis] + quantity.after;
}

}  // namespace

void add_bushing_columns(const JointModel& model, ResultTable& table) {
  for (const Bushing& bushing : model.bushings)
    for (const auto& quantities : {kDisplacement, kForces})
      for (std::size_t i = 0; i < 6; ++i) table.add_column(column(bushing, quantities[i / 3], i % 3));
}

void set_bushing_columns(const JointModel& model, const State& state, ResultTable& table) {
  for (const Bushing& bushing : model.bushings) {
    const BushingPoint point(bushing, state.poses[at(bushing.body_a)], state.poses[at(bushing.body_b)]);
    const Vec6 forces = point.on_frame(-bushing.stiffness * point.displacement());
    for (std::size_t i = 0; i < 6; ++i) {
      const Quantity &of_place = kDisplacement[i / 3], &of_force = kForces[i / 3];
      const auto k = static_cast<Eigen::Index>(i);
      table.set(column(bushing, of_place, i % 3), of_place.shown * point.displacement()[k]);
      table.set(column(bushing, of_force, i % 3), of_force.shown * forces[k]);
    }
  }
}

}  // namespace genu
