// Which joints of a model a scene can have.
#pragma once

#include <string>

#include "genu/osim/skeleton.h"

namespace genu::osim {

/// Whether a joint is one of a scene: a free joint (six free axes, each along a coordinate axis, moved by one
/// coordinate with slope 1 or, of a rotation, -1) or a revolute one (one rotation, nothing else moves). Fills in the
/// kind and its coordinates, not the bodies. `why_not` gets the reason where it is neither.
bool read_kind(const Joint& joint, MovingJoint& moving, std::string& why_not);

}  // namespace genu::osim
