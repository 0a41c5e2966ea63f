// Whether two meshes can be a femur and its tibia, in one frame and one unit.
#pragma once

#include <string>
#include <vector>

#include "genu/study/knee_layout.h"

namespace genu {

struct LayoutDoubt {
  bool impossible = false;  ///< no knee: else only worth a look
  std::string what;
};

/// Empty of a knee as it should be. `knee` is of these meshes.
std::vector<LayoutDoubt> doubts_about(const Mesh& femur, const Mesh& tibia, const KneeLayout& knee);

}  // namespace genu
