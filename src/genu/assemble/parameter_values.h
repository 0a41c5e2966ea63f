// The number that a parameter names (parameter_number() of model/parameters.h) in the scene's file.
#pragma once

#include <optional>
#include <string>

#include "genu/model/parameters.h"
#include "genu/scene/toml_document.h"

namespace genu {

/// Where the scene's file has a number, and what one of the file's units is in SI; empty where the file does not say
/// it.
struct ParameterPlace {
  const TomlNode* node = nullptr;
  std::string key;       ///< "joint.j1.stiffness", "ligament.AAC.from.point[1]"
  double file_unit = 1;  ///< SI per unit of the file
};
/// `parameter` must have a number in the scene.
ParameterPlace parameter_place(const SceneTables& scene, const Parameter& parameter, const TomlNode& document);

}  // namespace genu
