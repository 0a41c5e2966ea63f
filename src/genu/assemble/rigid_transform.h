// 4x4 matrices that are to be rigid motions: [R t; 0 0 0 1] with R R^T = 1 and det R = 1.
#pragma once

#include <string>

#include "genu/core/pose.h"
#include "genu/core/types.h"

namespace genu {

/// What is wrong with it, in words; empty if nothing is.
std::string fault_of_transform(const Mat4& transform);

/// The pose of a transform without fault, with the rotation nearest to its digits.
Pose pose_of_transform(const Mat4& transform);

}  // namespace genu
