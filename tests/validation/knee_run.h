// A knee solved from its scene, for tests that look at the scene and at what came of it.
#pragma once

#include <optional>

#include "genu/study/run_scene.h"

namespace genu::test {

struct KneeRun {
  std::optional<Prepared> prepared;
  Solution solution;
};

}  // namespace genu::test
