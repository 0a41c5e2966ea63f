// A model of OpenSim from a scene (docs/opensim.md): reads the scene and its meshes, writes a folder.
#pragma once

#include <optional>
#include <string>

#include "genu/core/diagnostics.h"
#include "genu/osim/export_scene.h"
#include "genu/scene/scene_changes.h"

namespace genu {

struct ModelExport {
  SceneSource source;
  std::string folder;         ///< made new
  std::string columns, side;  ///< names of coordinates (store/opensim_columns.h)
};

struct ExportReport {
  osim::ExportedModel model;
  std::string file;     ///< FOLDER/model.osim
  int meshes = 0;       ///< files in FOLDER/Geometry
  bool written = true;  ///< else why not is in the diagnostics: a full disk
};

/// Writes FOLDER/model.osim, export.csv, Geometry/ and, where the scene has cables, forces.sto. Empty, with every
/// reason in `out`, where something is refused; then nothing is written.
[[nodiscard]] std::optional<ExportReport> export_model(const ModelExport& asked, Diagnostics& out);

}  // namespace genu
