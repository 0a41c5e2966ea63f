// team.h
#pragma once

#include "blocked_range.h"
#include "team.h"

namespace tbb {

/// Pieces of at least the grain, and no more than a few for each thread.
template <class T, class Body>
void parallel_for(const blocked_range<T>& range, const Body& body) {
  constexpr std::size_t kPieces = 4 * team::kMostThreads;
  const auto size = static_cast<std::size_t>(range.end() - range.begin());
  if (size == 0) return;
  const std::size_t piece = std::max(range.grainsize(), (size + kPieces - 1) / kPieces);
  team::each(static_cast<int>((size + piece - 1) / piece), [&](int k) {
    const std::size_t first = static_cast<std::size_t>(k) * piece;
    body(blocked_range<T>(range.begin() + static_cast<T>(first),
                          range.begin() + static_cast<T>(std::min(first + piece, size))));
  });
}

template <class T, class Body>
void parallel_for(T first, T last, const Body& body) {
  if (first < last) team::each(static_cast<int>(last - first), [&](int k) { body(first + static_cast<T>(k)); });
}

}  // namespace tbb
