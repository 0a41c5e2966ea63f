// Which knee the meshes are, a left or a right one.
#pragma once

#include <string>

#include "genu/new_scene/asked_scene.h"
#include "genu/new_scene/new_bones.h"
#include "genu/new_scene/new_landmarks.h"
#include "genu/study/knee_layout.h"

namespace genu {

struct Side {
  bool left = false;
  std::string why;  ///< for the terminal
};

/// By what tells it first: the option, names of landmarks, epicondyles, the fibula, a clear shape, how the reference
/// knee fits, an unclear shape; else a right one.
Side side_of(const NewScene& asked, const KneeLayout& knee, const NewBones& bones, const KneeLandmarks& landmarks);

}  // namespace genu
