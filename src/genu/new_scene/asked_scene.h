// What `genu new` is asked for.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "genu/core/piece_files.h"

namespace genu {

struct NewScene {
  enum class Kind { analytic, stl, motion, given };
  Kind kind = Kind::analytic;
  std::string folder{};                   ///< made new; its last name is the scene's
  PieceFiles femur{}, tibia{};            ///< mesh files that touch, of kind stl; all in one frame
  PieceFiles femur_bone{}, tibia_bone{};  ///< under them, where those are cartilage alone; both or none
  PieceFiles femur_any{}, tibia_any{};    ///< in their place: bone and cartilage, told apart by shape (new_pieces.h)
  PieceFiles patella{}, patella_bone{};   ///< the same of the patella; all empty: the scene has none
  PieceFiles patella_any{};
  PieceFiles fibula{};                 ///< bone, on the tibia; empty: the scene has none
  std::string text{};                  ///< the scene of kind given, which names no files
  std::string unit{};                  ///< of kLengthUnits, of these files; empty: guessed from their size
  std::string proximal{}, anterior{};  ///< "x", "-x", ... in that frame; empty: guessed from the meshes
  std::optional<bool> left{};          ///< a left knee; empty: by the shape of the bones, else a right one
  std::string landmarks{};             ///< a file of points that a person has placed; empty: none
  std::string landmark_unit{};         ///< "mm" or "m" of a .csv of them; empty: that of the meshes
  double landmark_error = 0;           ///< m: of points whose file states none; 0: kLandmarkError
  std::string picture{};               ///< an .svg of the knee to write (knee_picture.h); empty: none
  bool edit = false;                   ///< the folder is there: write its scene again, and keep the user's changes
  std::function<bool()> cancelled{};   ///< whether to stop trying the scene out: then nothing is written
};

}  // namespace genu
