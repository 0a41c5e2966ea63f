// Whether two meshes can be a femur and its tibia, in one frame and one unit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/study/knee_layout.h"

namespace genu {

struct LayoutDoubt {
  bool impossible = false;  ///< no knee: else only worth a look
  std::string what;
};

/// Empty of a knee as it should be. `knee` is of these meshes; `tibia_unit` is m per unit of the tibia's file.
std::vector<LayoutDoubt> doubts_about(const Mesh& femur, const Mesh& tibia, const KneeLayout& knee, double tibia_unit);

/// Which knee it is by its shape: true for a left one. Empty where femur and tibia do not agree, or do not tell.
std::optional<bool> seems_left(const KneeLayout& knee);

/// "the femur reaches 2.7 mm further forward on its right half, and the tibia is 1.8 mm deeper on its left half"
std::string why_this_side(const KneeLayout& knee);

}  // namespace genu
