// Follows the steps of a scene: poses and events, of which nothing is said yet.
#pragma once

#include "genu/assemble/prepare.h"
#include "genu/assemble/solution.h"
#include "genu/model/contact_field.h"

namespace genu {

/// `options.path`, solved as exactly as the scene asks for: the tolerance of `options` stands for nothing.
PathOptions path_options(const SceneTables& scene, const RunOptions& options);

/// All steps. What could not be solved is in the statuses, never an error.
Solved solve_path(const Prepared& prepared, ContactField& field, const RunOptions& options);

}  // namespace genu
