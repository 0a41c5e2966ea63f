// A scene from a model of OpenSim (docs/opensim.md): reads the model and what belongs to it, writes a folder.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/osim/import_scene.h"

namespace genu {

struct ModelImport {
  std::string model;                ///< .osim
  std::vector<std::string> joints;  ///< that move; empty: all with six free axes that do not hang on the ground
  std::string pose;                 ///< .sto or .mot of coordinates; empty: defaults of the model
  std::string forces;               ///< .sto of muscle forces, N; empty: no tension
  int row = 1;                      ///< of both files, from 1
  std::string geometry;             ///< folder of mesh files, looked in first; empty: beside the model
  std::string folder;               ///< made new
};

struct ImportReport {
  osim::ImportedScene scene;
  std::string file;             ///< FOLDER/scene.toml
  std::size_t coordinates = 0;  ///< found in the pose file
  std::size_t tensions = 0;     ///< found in the forces file
  bool written = true;          ///< else why not is in the diagnostics: a full disk
};

/// Writes FOLDER/scene.toml and FOLDER/import.csv. Empty, with every reason in `out`, where something is refused; then
/// nothing is written.
[[nodiscard]] std::optional<ImportReport> import_model(const ModelImport& asked, Diagnostics& out);

}  // namespace genu
