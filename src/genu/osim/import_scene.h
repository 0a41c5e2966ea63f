// A model as the text of a scene.
#pragma once

#include <string>
#include <vector>

#include "genu/osim/scene_draft.h"

namespace genu::osim {

struct ImportedScene {
  std::string text;                  ///< of scene.toml
  std::string table;                 ///< of import.csv
  std::vector<std::string> summary;  ///< in words, a line for each kind of element and reason
  std::vector<std::string> bodies, joints;
  std::string columns;  ///< for `genu evaluate --columns`: empty where it knows the names by itself
  std::size_t kept = 0, frozen = 0, left_out = 0;
};

/// The scene of `model` with what `skeleton` moves.
ImportedScene import_scene(const Model& model, const Skeleton& skeleton, const SceneRequest& request);

}  // namespace genu::osim
