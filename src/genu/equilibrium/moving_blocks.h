// Blocks of a 12-wide row or column (two bodies) that belong to moving bodies.
#pragma once

#include <array>
#include <cstddef>

#include "genu/core/which_move.h"

namespace genu {

/// `bodies`: indices among the moving bodies; negative for fixed ones.
inline WhichMove which_move(const std::array<int, 2>& bodies) { return {bodies[0] >= 0, bodies[1] >= 0}; }

/// Calls add(from, to) for each such block: offset in the row of the pair, and in the row of all moving bodies.
template <typename Add>
void for_moving(const std::array<int, 2>& bodies, Add add) {
  for (int i = 0; i < 2; ++i)
    if (bodies[static_cast<std::size_t>(i)] >= 0) add(6 * i, 6 * bodies[static_cast<std::size_t>(i)]);
}

}  // namespace genu
