// Whether the anatomical axes of a joint (Grood and Suntay's) suit the meshes of its bones.
#pragma once

#include "genu/assemble/prepare.h"
#include "genu/core/diagnostics.h"

namespace genu {

/// Warns where the bones that a joint's `grood_suntay` names, at the reference coordinates, look like the other knee,
/// or cannot be a femur over its tibia along those axes: the surfaces of the contacts between the two bodies tell.
void warn_about_anatomy(const Prepared& prepared, Diagnostics& out);

}  // namespace genu
