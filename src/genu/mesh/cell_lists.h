// For each cell of a uniform grid, the balls that reach into it: one look-up answers "who may reach this point".
#pragma once

#include <span>
#include <vector>

#include "genu/core/types.h"

namespace genu {

class CellLists {
 public:
  CellLists() = default;

  /// Balls of centre centres[i] and radius radii[i] (m; a single entry holds for all) in cells of about `cell` (m).
  /// Cells grow where a fine grid would not fit into memory: lists get longer, answers stay the same.
  CellLists(std::span<const Vec3> centres, std::span<const double> radii, double cell);

  /// Index of the cell that holds x, or -1 outside the grid (and for a NaN).
  int cell_of(const Vec3& x) const {
    const Vec3 t = (x - origin_) * inverse_cell_;
    const bool above = t.x() >= 0 && t.y() >= 0 && t.z() >= 0;
    if (!(above && t.x() < size_[0] && t.y() < size_[1] && t.z() < size_[2])) return -1;
    return static_cast<int>(t.x()) + size_[0] * (static_cast<int>(t.y()) + size_[1] * static_cast<int>(t.z()));
  }

  /// The balls that may hold a point of the cell, in ascending order; empty for cell -1.
  std::span<const int> list(int cell) const {
    if (cell < 0) return {};
    return {items_.data() + first_[cell], static_cast<std::size_t>(first_[cell + 1] - first_[cell])};
  }
  std::span<const int> at(const Vec3& x) const { return list(cell_of(x)); }

  int cell_count() const { return static_cast<int>(first_.size()) - 1; }

  template <typename Archive>
  void serialize(Archive& a) {
    a(origin_, inverse_cell_, size_, first_, items_);
  }

 private:
  Vec3 origin_ = Vec3::Zero();
  double inverse_cell_ = 0;
  int size_[3] = {0, 0, 0};
  std::vector<int> first_ = {0};
  std::vector<int> items_;
};

}  // namespace genu
