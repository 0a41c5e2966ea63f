#include "genu/mesh/stair_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include <Eigen/Geometry>

#include "genu/mesh/tolerances.h"

namespace genu {
namespace {

struct Facet {
  Vec3 normal, middle;
  double area;
};

std::vector<Facet> facets_of(const Mesh& mesh) {
  std::vector<Facet> out;
  out.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[at(t[0])], &b = mesh.vertices[at(t[1])], &c = mesh.vertices[at(t[2])];
    const Vec3 twice = (b - a).cross(c - a);
    if (twice.norm() > 0) out.push_back({twice.normalized(), (a + b + c) / 3, 0.5 * twice.norm()});
  }
  return out;
}

/// Up to three directions across each other, each the one that most area faces, either way.
std::vector<Vec3> candidates(const std::vector<Facet>& facets) {
  std::map<std::array<int, 3>, std::pair<double, Vec3>> cells;
  for (const Facet& f : facets) {
    Eigen::Index largest = 0;
    f.normal.cwiseAbs().maxCoeff(&largest);
    const Vec3 n = f.normal[largest] < 0 ? Vec3(-f.normal) : f.normal;
    std::array<int, 3> cell{};
    for (std::size_t i = 0; i < 3; ++i)
      cell[i] = static_cast<int>(std::lround(n[static_cast<Eigen::Index>(i)] / kStepDirectionCell));
    auto& [area, sum] = cells.try_emplace(cell, 0.0, Vec3::Zero()).first->second;
    area += f.area;
    sum += f.area * n;
  }
  std::vector<std::pair<double, Vec3>> found;
  for (const auto& [cell, area_and_sum] : cells)
    found.emplace_back(area_and_sum.first, area_and_sum.second.normalized());
  std::stable_sort(found.begin(), found.end(), [](const auto& p, const auto& q) { return p.first > q.first; });
  std::vector<Vec3> out;
  for (const auto& area_and_direction : found) {
    const Vec3& direction = area_and_direction.second;
    const bool across =
        std::all_of(out.begin(), out.end(), [&](const Vec3& d) { return std::abs(d.dot(direction)) < kStepsAcross; });
    if (across) out.push_back(direction);
    if (out.size() == 3) break;
  }
  return out;
}

/// Heights of the planes that facets facing along `direction` lie in, rising; those of less than a share of the area
/// are left out.
struct Levels {
  std::vector<double> heights;  ///< m
  double area = 0;              ///< m^2, of all of them
};

Levels levels_along(const Vec3& direction, const std::vector<Facet>& facets, double edge) {
  std::vector<std::pair<double, double>> flat;  // height, area
  for (const Facet& f : facets)
    if (std::abs(f.normal.dot(direction)) > kFlatStep) flat.emplace_back(direction.dot(f.middle), f.area);
  std::sort(flat.begin(), flat.end());
  Levels out;
  double all = 0;
  for (const auto& [height, area] : flat) all += area;
  const double spread = kLevelSpread * edge;
  for (std::size_t first = 0; first < flat.size();) {
    std::size_t last = first;
    double area = 0, moment = 0;
    do {
      area += flat[last].second;
      moment += flat[last].second * flat[last].first;
      ++last;
    } while (last < flat.size() && flat[last].first - flat[last - 1].first <= kLevelGap * spread);
    const bool level = flat[last - 1].first - flat[first].first <= spread;  // else heights of all sizes: no steps
    if (level && area > kLeastLevelShare * all) {
      out.heights.push_back(moment / area);
      out.area += area;
    }
    first = last;
  }
  return out;
}

/// The spacing of levels, 0 unless nearly all are a whole number of spacings apart.
double even_spacing(const std::vector<double>& heights) {
  if (static_cast<int>(heights.size()) < kLeastLevels) return 0;
  std::vector<double> gaps;
  for (std::size_t i = 1; i < heights.size(); ++i) gaps.push_back(heights[i] - heights[i - 1]);
  std::nth_element(gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2), gaps.end());
  const double step = gaps[gaps.size() / 2];
  const auto even = std::count_if(gaps.begin(), gaps.end(), [&](double gap) {
    const double steps = gap / step;
    return std::round(steps) >= 1 && std::abs(steps - std::round(steps)) < kEvenStep;
  });
  return static_cast<double>(even) >= kEvenShare * static_cast<double>(gaps.size()) ? step : 0;
}

}  // namespace

std::optional<StairSteps> stair_steps(const Mesh& mesh) {
  const std::vector<Facet> facets = facets_of(mesh);
  double area = 0;
  for (const Facet& f : facets) area += f.area;
  if (!(area > 0)) return std::nullopt;
  const double edge = std::sqrt(area / static_cast<double>(facets.size()));
  std::optional<StairSteps> best;
  double squares = 0;
  for (const Vec3& direction : candidates(facets)) {
    const Levels levels = levels_along(direction, facets, edge);
    const double share = levels.area / area, height = even_spacing(levels.heights);
    if (height < kLeastStepHeight * edge || share < kLeastStepsShare) continue;
    squares += height * height / 12;
    if (!best || height > best->height * kAlikeHeights)
      best = StairSteps{direction, height, share, static_cast<int>(levels.heights.size()), 0};
  }
  if (best) best->rms = std::sqrt(squares);
  return best;
}

}  // namespace genu
