// The columns that a scene's results.csv must have to be judged.
#pragma once

#include <string>
#include <vector>

#include "genu/scene/scene.h"

namespace genu::judge {

std::vector<std::string> required_columns(const Scene& scene);

}  // namespace genu::judge
