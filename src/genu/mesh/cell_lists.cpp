#include "genu/mesh/cell_lists.h"

#include <algorithm>
#include <cmath>

#include "genu/mesh/tolerances.h"

namespace genu {

CellLists::CellLists(std::span<const Vec3> centres, std::span<const double> radii, double cell) {
  if (centres.empty() || radii.empty()) return;
  const auto radius = [&](std::size_t i) { return radii.size() == 1 ? radii[0] : radii[i]; };
  Vec3 low = centres[0], high = centres[0];
  for (std::size_t i = 0; i < centres.size(); ++i) {
    low = low.cwiseMin((centres[i].array() - radius(i)).matrix());
    high = high.cwiseMax((centres[i].array() + radius(i)).matrix());
  }
  const Vec3 extent = high - low;
  while ((extent / cell).array().ceil().max(1.0).prod() > kMaxGridCells) cell *= 1.25;
  origin_ = low;
  inverse_cell_ = 1 / cell;
  for (int k = 0; k < 3; ++k) size_[k] = std::max(1, static_cast<int>(std::ceil(extent[k] / cell)));

  // Visits the cells that ball i reaches into; a hair of slack covers the rounding of cell_of.
  const auto visit = [&](std::size_t i, auto&& action) {
    const double r = radius(i) * (1 + 1e-9) + 1e-9 * cell;
    const Vec3 t = centres[i] - origin_;
    int from[3], to[3];
    for (int k = 0; k < 3; ++k) {
      from[k] = std::max(0, static_cast<int>(std::floor((t[k] - r) * inverse_cell_)));
      to[k] = std::min(size_[k] - 1, static_cast<int>(std::floor((t[k] + r) * inverse_cell_)));
    }
    const auto beyond = [&](int k, int index) {
      const double d = std::max({0.0, index * cell - t[k], t[k] - (index + 1) * cell});
      return d * d;
    };
    for (int z = from[2]; z <= to[2]; ++z) {
      for (int y = from[1]; y <= to[1]; ++y) {
        const double yz = beyond(2, z) + beyond(1, y);
        if (yz > r * r) continue;
        for (int x = from[0]; x <= to[0]; ++x) {
          if (yz + beyond(0, x) <= r * r) action(x + size_[0] * (y + size_[1] * z));
        }
      }
    }
  };
  first_.assign(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2] + 1, 0);
  for (std::size_t i = 0; i < centres.size(); ++i) visit(i, [&](int c) { ++first_[c + 1]; });
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  items_.resize(first_.back());
  std::vector<int> fill(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < centres.size(); ++i) visit(i, [&](int c) { items_[fill[c]++] = static_cast<int>(i); });
}

}  // namespace genu
