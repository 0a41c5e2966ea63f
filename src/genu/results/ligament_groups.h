// Ligaments under one name: the bundles of a scene, and fibres with one name and numbers behind it: ACLam1 ... ACLam6
// are ACLam.
#pragma once

#include <string>
#include <vector>

#include "genu/scene/scene.h"

namespace genu {

struct LigamentGroup {
  std::string name;
  std::vector<std::size_t> members;  ///< indices into Scene::ligaments
  bool bundle = false;               ///< named by the scene
};

/// Bundles that have fibres, in the scene's order; then what is in none, in the order of the first fibres.
std::vector<LigamentGroup> ligament_groups(const SceneTables& scene);

/// The column of results.csv with the force of a whole group; empty where none has it.
std::string force_column(const SceneTables& scene, const LigamentGroup& group);

}  // namespace genu
