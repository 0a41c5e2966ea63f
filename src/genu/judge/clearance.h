// How far points are at least from a set of boxes: a grid that counts the cells to the nearest one with a box.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "genu/core/types.h"

namespace genu::judge {

class Clearance {
 public:
  struct Box {
    Vec3 low, high;  ///< m
  };

  Clearance() = default;
  explicit Clearance(const std::vector<Box>& boxes);

  /// Whether every box is farther than `reach` (m) from x.
  bool beyond(const Vec3& x, double reach) const;

 private:
  std::array<int, 3> cell_of(const Vec3& x) const;
  std::size_t number(const std::array<int, 3>& cell) const;
  void spread();

  Vec3 low_ = Vec3::Zero();
  double cell_ = 0;  // m; 0: no boxes
  std::array<int, 3> across_{};
  std::vector<int> rings_;  // of each cell: to the nearest with a box, across faces, edges or corners
};

}  // namespace genu::judge
