// A scene of meshes/ solved from its file, for studies that look at more than its tables.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "genu/study/run_scene.h"

namespace genu::studies {

struct SolvedScene {
  Prepared prepared;
  Solution solution;

  /// A column as numbers, NaN where a cell is empty.
  std::vector<double> column(const std::string& name) const;
  /// Whether every pose is solved, certified and stable.
  bool all_stable() const;
};

/// Null where the scene is refused: why is in `out`.
std::unique_ptr<SolvedScene> solve_scene(const std::string& file, Diagnostics& out);
/// The same of a scene in memory, which names no files or those of `meshes`.
std::unique_ptr<SolvedScene> solve_scene(const Scene& scene, Diagnostics& out,
                                         std::shared_ptr<MeshLibrary> meshes = std::make_shared<MeshLibrary>());

/// What a study leaves in a knee's folder: file names and their contents.
using Files = std::vector<std::pair<std::string, std::string>>;

}  // namespace genu::studies
