// Numbers of landmarks that decide an outcome. docs/tolerances.md is made from this header.
#pragma once

#include <cstddef>

namespace genu {

// json_places

/// [1] Deepest nesting of JSON that is read (markups of 3D Slicer: 5). Fails first: if too large, the stack.
inline constexpr std::size_t kMostNested = 64;

// landmark_file

/// [unit of the file] Largest coordinate. Fails first: nothing (numbers that are no place in a body).
inline constexpr double kFarthestLandmark = 1e6;

}  // namespace genu
