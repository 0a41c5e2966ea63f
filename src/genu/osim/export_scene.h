// A scene as the text of a model of OpenSim, in the elements of OpenSim-JAM: the way back of import_scene.h.
#pragma once

#include <string>
#include <vector>

#include "genu/osim/export_request.h"

namespace genu::osim {

struct ExportedModel {
  std::string text;                  ///< of the .osim
  std::string table;                 ///< of export.csv: kind, name, fate, in_model, reason; each object once
  std::string forces;                ///< of a .sto with the tensions of cables, N; empty where there are none
  std::vector<std::string> summary;  ///< in words, a line for each reason
  std::vector<std::string> joints;   ///< that move
  std::size_t kept = 0, left_out = 0;
};

/// The scene with the origins of its file and the masses of its solids. Its joints lead from what is fixed outwards,
/// one to each moving body, as those of OpenSim do from the ground.
ExportedModel export_scene(const SceneTables& scene, const ExportRequest& request);

}  // namespace genu::osim
