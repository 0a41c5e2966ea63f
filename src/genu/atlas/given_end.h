// An end of a ligament that is known otherwise than by the reference knee.
#pragma once

#include <string>
#include <vector>

#include "genu/core/types.h"

namespace genu {

/// Where the middle of all fibres of some bundles is on one bone: they keep their places about it.
struct GivenEnd {
  std::string name;                  ///< as the user calls it
  std::vector<std::string> bundles;  ///< of the reference knee
  bool femur = false;                ///< else on the tibia, or on the fibula beside it
  Vec3 at = Vec3::Zero();            ///< m, in the frame of the meshes
  double error = 0;                  ///< m: standard deviation
};

}  // namespace genu
