// A law of the caller's own as a ligament's. Not installed.
#pragma once

#include <string>

#include "genu/api/scene.h"
#include "genu/model/ligament_law.h"

namespace genu::api {

/// Throws SceneError for a law that cannot be.
LigamentLaw law_of(const std::string& ligament, const Law& law);

}  // namespace genu::api
