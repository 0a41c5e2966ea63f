// The number that a parameter names: in the scene as data, and in the scene's file.
#pragma once

#include <optional>
#include <string>

#include "genu/model/parameters.h"
#include "genu/scene/toml_document.h"

namespace genu {

/// The number (SI) in the scene; null where it is not a single number of ligaments, loads, bodies or joints: sizes of
/// surfaces, load factors, prescribed values.
double* parameter_number(Scene& scene, const Parameter& parameter);

/// Where the scene's file has it, and what one of the file's units is in SI; empty where the file does not say it.
struct ParameterPlace {
  const TomlNode* node = nullptr;
  std::string key;       ///< "joint.j1.stiffness", "ligament.AAC.from.point[1]"
  double file_unit = 1;  ///< SI per unit of the file
};
ParameterPlace parameter_place(const SceneTables& scene, const Parameter& parameter, const TomlNode& document);

}  // namespace genu
