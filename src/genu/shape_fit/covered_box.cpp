#include "genu/shape_fit/covered_box.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "genu/shape_fit/tolerances.h"

namespace genu {
namespace {

constexpr int kCells = 48;  // each way

/// Which cells of a rectangle the zone's triangles reach, as sums over all cells below and left.
class Occupancy {
 public:
  Occupancy(const std::vector<ChartPoint>& points, const Mesh& zone, const ChartBox& extent) : extent_(extent) {
    std::vector<char> filled(kCells * kCells, 0);
    for (const auto& t : zone.triangles) fill(points, t, filled);
    for (int i = 0; i < kCells; ++i)
      for (int j = 0; j < kCells; ++j)
        sum(i + 1, j + 1) =
            sum(i, j + 1) + sum(i + 1, j) - sum(i, j) + filled[static_cast<std::size_t>(i * kCells + j)];
  }

  /// Filled cells of columns [i0, i1) and rows [j0, j1).
  int count(int i0, int i1, int j0, int j1) const { return at(i1, j1) - at(i0, j1) - at(i1, j0) + at(i0, j0); }

  double u(int i) const { return i == kCells ? extent_.u1 : extent_.u0 + extent_.width() * i / kCells; }
  double v(int j) const { return j == kCells ? extent_.v1 : extent_.v0 + extent_.height() * j / kCells; }

 private:
  int& sum(int i, int j) { return sums_[static_cast<std::size_t>(i * (kCells + 1) + j)]; }
  int at(int i, int j) const { return sums_[static_cast<std::size_t>(i * (kCells + 1) + j)]; }

  /// Points all over the triangle, at most a third of a cell apart.
  void fill(const std::vector<ChartPoint>& points, const std::array<int, 3>& t, std::vector<char>& filled) const {
    std::array<Vec2, 3> c;
    for (std::size_t k = 0; k < 3; ++k) {
      const ChartPoint& q = points[static_cast<std::size_t>(t[k])];
      c[k] = Vec2((q.u - extent_.u0) / extent_.width(), (q.v - extent_.v0) / extent_.height()) * kCells;
    }
    const double longest = std::max({(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm()});
    if (!(longest < kCells)) return;  // across the cut of a cylinder
    const int n = std::max(1, static_cast<int>(std::ceil(3 * longest)));
    for (int a = 0; a <= n; ++a) {
      for (int b = 0; a + b <= n; ++b) {
        const Vec2 q = c[0] + (c[1] - c[0]) * a / n + (c[2] - c[0]) * b / n;
        const auto i = static_cast<int>(std::floor(q.x())), j = static_cast<int>(std::floor(q.y()));
        if (i < 0 || j < 0 || i >= kCells || j >= kCells) continue;
        filled[static_cast<std::size_t>(i * kCells + j)] = 1;
      }
    }
  }

  ChartBox extent_;
  std::vector<int> sums_ = std::vector<int>((kCells + 1) * (kCells + 1), 0);
};

ChartBox extent_of(const std::vector<ChartPoint>& points) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  ChartBox box{kInfinity, -kInfinity, kInfinity, -kInfinity};
  for (const ChartPoint& q : points) {
    box.u0 = std::min(box.u0, q.u), box.u1 = std::max(box.u1, q.u);
    box.v0 = std::min(box.v0, q.v), box.v1 = std::max(box.v1, q.v);
  }
  return box;
}

ChartBox common(const ChartBox& a, const ChartBox& b) {
  return {std::max(a.u0, b.u0), std::min(a.u1, b.u1), std::max(a.v0, b.v0), std::min(a.v1, b.v1)};
}

}  // namespace

std::optional<CoveredBox> covered_box(const Mesh& zone, const SurfaceChart& chart,
                                      const std::optional<ChartBox>& limits, const std::optional<ChartBox>& keep) {
  std::vector<ChartPoint> points;
  points.reserve(zone.vertices.size());
  for (const Vec3& p : zone.vertices) points.push_back(chart.coordinates(p));
  if (points.empty()) return std::nullopt;
  ChartBox extent = extent_of(points);
  if (limits) extent = common(extent, *limits);
  if (!(extent.width() > 0) || !(extent.height() > 0)) return std::nullopt;
  const Occupancy cells(points, zone, extent);

  // What has to stay: the columns and rows that `keep` reaches.
  int left = kCells, right = 0, bottom = kCells, top = 0;
  if (keep) {
    const auto column = [&](double u) { return kCells * (u - extent.u0) / extent.width(); };
    const auto row = [&](double v) { return kCells * (v - extent.v0) / extent.height(); };
    left = std::clamp(static_cast<int>(std::floor(column(keep->u0))), 0, kCells - 1);
    right = std::clamp(static_cast<int>(std::ceil(column(keep->u1))), left + 1, kCells);
    bottom = std::clamp(static_cast<int>(std::floor(row(keep->v0))), 0, kCells - 1);
    top = std::clamp(static_cast<int>(std::ceil(row(keep->v1))), bottom + 1, kCells);
  }
  CoveredBox best;
  double best_score = -std::numeric_limits<double>::infinity();
  for (int i0 = 0; i0 <= std::min(left, kCells - 1); ++i0) {
    for (int i1 = std::max(i0 + 1, right); i1 <= kCells; ++i1) {
      for (int j0 = 0; j0 <= std::min(bottom, kCells - 1); ++j0) {
        for (int j1 = std::max(j0 + 1, top); j1 <= kCells; ++j1) {
          const int all = (i1 - i0) * (j1 - j0), filled = cells.count(i0, i1, j0, j1);
          const double score = filled - kBareSpotCost * (all - filled);
          if (score <= best_score) continue;
          best_score = score;
          best = {{cells.u(i0), cells.u(i1), cells.v(j0), cells.v(j1)}, static_cast<double>(filled) / all};
        }
      }
    }
  }
  return best;
}

}  // namespace genu
