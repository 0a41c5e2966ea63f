// The extensor mechanism of a joint whose `grood_suntay` names a patella:
//
//   JOINT.quadriceps.force_N       sum of the tensions of the cables, and forces toward a point, that pull the patella
//   JOINT.patellar_tendon.force_N  sum of the ligaments between the patella and a body other than the femur
//   JOINT.tendon_to_quadriceps     the second over the first
#pragma once

#include "genu/model/joint_model.h"
#include "genu/model/state.h"
#include "genu/results/result_table.h"
#include "genu/scene/scene.h"

namespace genu {

struct ExtensorMechanism {
  std::string joint;
  std::vector<std::size_t> quadriceps;  ///< indices of loads
  std::vector<std::size_t> tendon;      ///< indices of ligaments
  std::vector<std::string> contacts;    ///< names of those between femur and patella

  std::string quadriceps_column() const { return joint + ".quadriceps.force_N"; }
  std::string tendon_column() const { return joint + ".patellar_tendon.force_N"; }
  std::string ratio_column() const { return joint + ".tendon_to_quadriceps"; }
};

/// Those with both muscle and tendon.
std::vector<ExtensorMechanism> extensor_mechanisms(const PlacedScene& scene);

/// N: of a load with one tension.
double load_tension(const JointModel& model, const Target& target, const State& state, std::size_t load);

void add_extensor_columns(const PlacedScene& scene, ResultTable& table);
/// In the last row, from the columns of the ligaments there.
void set_extensor_columns(const PlacedScene& scene, const JointModel& model, const Target& target, const State& state,
                          ResultTable& table);

}  // namespace genu
