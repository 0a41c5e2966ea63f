// A scene to start from: commented, and written so that it runs as it stands.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "genu/core/diagnostics.h"

namespace genu {

struct NewScene {
  enum class Kind { analytic, stl, motion, given };
  Kind kind = Kind::analytic;
  std::string folder{};                    ///< made new; its last name is the scene's
  std::string femur{}, tibia{};            ///< mesh files that touch, of kind stl; all in one frame
  std::string femur_bone{}, tibia_bone{};  ///< under them, where those are cartilage alone; both or none
  std::string text{};                      ///< the scene of kind given, which names no files
  std::string unit{};                      ///< of kLengthUnits, of these files; empty: guessed from their size
  std::string proximal{}, anterior{};      ///< "x", "-x", ... in that frame; empty: guessed from the meshes
  std::optional<bool> left{};              ///< a left knee; empty: by the shape of the bones, else a right one
  std::string landmarks{};                 ///< a file of points that a person has placed; empty: none
  std::string landmark_unit{};             ///< "mm" or "m" of a .csv of them; empty: that of the meshes
  double landmark_error = 0;               ///< m: of points whose file states none; 0: kLandmarkError
  std::string picture{};                   ///< an .svg of the knee to write (knee_picture.h); empty: none
  bool edit = false;                       ///< the folder is there: write its scene again, and keep the user's changes
  std::function<bool()> cancelled{};       ///< whether to stop trying the scene out: then nothing is written
};

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
