// What `genu new` is asked for a knee of the drawn bones in meshes/leskovar2019.
#pragma once

#include <string>

#include "genu/new_scene/asked_scene.h"
#include "support/leskovar.h"

namespace genu::test {

inline NewScene drawn_knee_in(const std::string& folder) {
  return {.kind = NewScene::Kind::stl,
          .folder = folder,
          .femur = kLeskovar + "femur.stl",
          .tibia = kLeskovar + "tibia.stl"};
}

}  // namespace genu::test
