#include "genu/judge/clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "genu/judge/tolerances.h"

namespace genu::judge {

Clearance::Clearance(const std::vector<Box>& boxes) {
  if (boxes.empty()) return;
  Vec3 high = boxes[0].high;
  low_ = boxes[0].low;
  for (const Box& box : boxes) low_ = low_.cwiseMin(box.low), high = high.cwiseMax(box.high);
  cell_ = std::max((high - low_).maxCoeff() / kClearanceCells, 1e-9);
  const std::array<int, 3> last = cell_of(high);
  for (std::size_t i = 0; i < 3; ++i) across_[i] = last[i] + 1;
  rings_.assign(at(across_[0]) * at(across_[1]) * at(across_[2]), -1);
  for (const Box& box : boxes) {
    const std::array<int, 3> from = cell_of(box.low), to = cell_of(box.high);
    for (int i = from[0]; i <= to[0]; ++i)
      for (int j = from[1]; j <= to[1]; ++j)
        for (int k = from[2]; k <= to[2]; ++k) rings_[number({i, j, k})] = 0;
  }
  spread();
}

std::array<int, 3> Clearance::cell_of(const Vec3& x) const {
  const Vec3 c = ((x - low_) / cell_).array().floor();
  return {static_cast<int>(c.x()), static_cast<int>(c.y()), static_cast<int>(c.z())};
}

std::size_t Clearance::number(const std::array<int, 3>& cell) const {
  return (at(cell[0]) * at(across_[1]) + at(cell[1])) * at(across_[2]) + at(cell[2]);
}

/// Ring by ring, from the cells with boxes.
void Clearance::spread() {
  std::vector<std::array<int, 3>> front, next;
  for (int i = 0; i < across_[0]; ++i)
    for (int j = 0; j < across_[1]; ++j)
      for (int k = 0; k < across_[2]; ++k)
        if (rings_[number({i, j, k})] == 0) front.push_back({i, j, k});
  for (int ring = 1; !front.empty(); ++ring, front.swap(next), next.clear())
    for (const auto& c : front)
      for (int i = std::max(0, c[0] - 1); i <= std::min(across_[0] - 1, c[0] + 1); ++i)
        for (int j = std::max(0, c[1] - 1); j <= std::min(across_[1] - 1, c[1] + 1); ++j)
          for (int k = std::max(0, c[2] - 1); k <= std::min(across_[2] - 1, c[2] + 1); ++k) {
            int& rings = rings_[number({i, j, k})];
            if (rings >= 0) continue;
            rings = ring;
            next.push_back({i, j, k});
          }
}

bool Clearance::beyond(const Vec3& x, double reach) const {
  if (cell_ == 0) return true;
  const Vec3 size(across_[0], across_[1], across_[2]);
  const Vec3 inside = x.cwiseMax(low_).cwiseMin(low_ + cell_ * size);
  // Beside the grid at least as far as the grid is, and within it as far as the cells between are wide.
  if ((x - inside).norm() > reach) return true;
  std::array<int, 3> cell = cell_of(inside);
  for (std::size_t i = 0; i < 3; ++i) cell[i] = std::clamp(cell[i], 0, across_[i] - 1);
  return (rings_[number(cell)] - 1) * cell_ - (x - inside).norm() > reach;
}

}  // namespace genu::judge
