// From what a file says about a solid to its function.
#pragma once

#include "genu/scene/solid_def.h"
#include "genu/shape_fit/solid_field.h"

namespace genu {

/// `def` must have parts, as the reader sees to.
SolidField make_solid(const SolidDef& def);

}  // namespace genu
