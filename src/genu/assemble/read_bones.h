// The bones under surfaces whose thickness is measured.
#pragma once

#include "genu/model/joint_model.h"

namespace genu {

/// Reads them, in the frames of their bodies. What cannot be read is said in `out` and null. A file that several
/// surfaces name is read for each.
Bones read_bones(const Scene& scene, Diagnostics& out);

}  // namespace genu
