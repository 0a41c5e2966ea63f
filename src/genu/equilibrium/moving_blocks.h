// The blocks of a 12-wide row or column, of two bodies, that belong to bodies that move.
#pragma once

#include <array>
#include <cstddef>

#include "genu/core/which_move.h"

namespace genu {

/// Of two bodies, by their indices among those that move.
inline WhichMove which_move(const std::array<int, 2>& bodies) { return {bodies[0] >= 0, bodies[1] >= 0}; }

/// add(from, to) for each such block: where it begins in the row of the pair, and in that of all moving bodies.
template <typename Add>
void for_moving(const std::array<int, 2>& bodies, Add add) {
  for (int i = 0; i < 2; ++i)
    if (bodies[static_cast<std::size_t>(i)] >= 0) add(6 * i, 6 * bodies[static_cast<std::size_t>(i)]);
}

}  // namespace genu
