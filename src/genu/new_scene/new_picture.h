// The picture of a new scene (knee_picture.h).
#pragma once

#include <string>
#include <vector>

#include "genu/new_scene/new_bones.h"
#include "genu/new_scene/new_landmarks.h"
#include "genu/scene/scene.h"
#include "genu/study/knee_layout.h"

namespace genu {

/// What `genu new` knows of a knee.
struct NewKnee {
  NewBones bones;
  KneeLayout layout;
  bool left = false;
  KneeLandmarks landmarks;
  std::string choice;  ///< of ligaments
  std::string doubt;   ///< why the reference knee was not taken; empty: it was
};

/// SVG: the ends of the scene's ligaments, with the errors of those that are where the reference knee or a landmark has
/// them.
std::string picture_of(const NewKnee& knee, const Scene& scene);

}  // namespace genu
