// Fibres of one ligament, recognised by their names: ACLam1 ... ACLam6 are ACLam.
#pragma once

#include <string>
#include <vector>

#include "genu/scene/scene.h"

namespace genu {

struct LigamentGroup {
  std::string name;
  std::vector<std::size_t> members;  ///< indices into Scene::ligaments
};

/// In the order of their first fibres.
std::vector<LigamentGroup> ligament_groups(const SceneTables& scene);

}  // namespace genu
