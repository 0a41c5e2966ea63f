// A scene to start from: commented, and written so that it runs as it stands.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/new_scene/asked_scene.h"

namespace genu {

/// What has been written, and what a trial of it gave.
struct NewSceneReport {
  std::string file;
  std::vector<std::string> choices;  ///< what was found in the meshes or chosen for want of knowledge, a line each
  int poses_solved = 0, poses_asked = 0;
  bool written = true;               ///< else why not is in the diagnostics: a full disk
  std::vector<std::string> verdict;  ///< where not every pose of the trial is ok: why, and what to do
};

/// Writes FOLDER/NAME.toml and solves it once; of kind stl also what --edit needs later (new_edit.h). Empty, with the
/// reasons in `out`, where what is asked is refused: the folder exists, or a mesh cannot be read. Of kind stl the
/// flexion that is asked for ends where the trial did.
[[nodiscard]] std::optional<NewSceneReport> write_new_scene(const NewScene& asked, Diagnostics& out);

}  // namespace genu
