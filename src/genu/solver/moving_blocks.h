// The blocks of a 12-wide row or column, of two bodies, that belong to bodies that move.
#pragma once

#include <array>
#include <cstddef>

namespace genu {

/// add(from, to) for each such block: where it begins in the row of the pair, and in that of all moving bodies.
template <typename Add>
void for_moving(const std::array<int, 2>& bodies, Add add) {
  for (int i = 0; i < 2; ++i)
    if (bodies[static_cast<std::size_t>(i)] >= 0) add(6 * i, 6 * bodies[static_cast<std::size_t>(i)]);
}

}  // namespace genu
