// The mesh files of hard cases, made from shapes and damage by rules: the same bytes every time.
#pragma once

#include <string>

#include "genu/scene/scene.h"
#include "hard_cases/hard_case.h"

namespace genu {

/// Writes the file of `recipe` into `folder`; `shapes` has the surfaces and solids by name. Returns what went wrong,
/// else an empty text.
std::string write_recipe(const MeshRecipe& recipe, const Scene& shapes, const std::string& folder);

}  // namespace genu
