// What the writer of a model needs beside the scene.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "genu/scene/scene.h"

namespace genu::osim {

/// What a scene alone does not say.
struct ExportRequest {
  std::string name;                                                ///< of the model
  std::vector<std::pair<CoordinateRef, std::string>> coordinates;  ///< what OpenSim calls each that no joint holds
  std::vector<double> slack_lengths;                               ///< m, of each ligament; NaN where its law has none
  std::vector<double> search_depths;                               ///< m, of each elastic layer
  std::vector<std::string> meshes, bones;                          ///< files of each surface; empty where it has none
};

}  // namespace genu::osim
