#include "genu/shape_fit/fit_zone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "genu/mesh/mesh_part.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/shape_fit/chart_choice.h"
#include "genu/shape_fit/tolerances.h"

namespace genu {
namespace {

constexpr int kSectors = 72;  // of 5 deg round the axis

bool is_closed(const Mesh& mesh) {
  const std::vector<MeshEdge> edges = mesh_edges(mesh);
  return std::none_of(edges.begin(), edges.end(), [](const MeshEdge& e) { return e.count == 1; });
}

Vec3 centroid_of(const Mesh& mesh) {
  Vec3 sum = Vec3::Zero();
  double area = 0;
  for (const OrientedPoint& q : oriented_points(mesh)) sum += q.area * q.p, area += q.area;
  return area > 0 ? Vec3(sum / area) : sum;
}

/// By place along the direction from one to the other of the two that lie farthest apart.
void sort_by_place(std::vector<Zone>& zones) {
  std::vector<std::pair<Vec3, std::size_t>> centres;
  for (std::size_t k = 0; k < zones.size(); ++k) centres.emplace_back(centroid_of(zones[k].mesh), k);
  Vec3 along = Vec3::Zero();
  for (const auto& [a, i] : centres)
    for (const auto& [b, j] : centres)
      if ((b - a).norm() > along.norm()) along = b - a;
  Eigen::Index axis = 0;
  along.cwiseAbs().maxCoeff(&axis);
  if (along[axis] < 0) along = -along;
  std::stable_sort(centres.begin(), centres.end(),
                   [&](const auto& a, const auto& b) { return along.dot(a.first) < along.dot(b.first); });
  std::vector<Zone> sorted;
  for (const auto& [centre, k] : centres) sorted.push_back(std::move(zones[k]));
  zones = std::move(sorted);
}

/// The middle of the widest gap between sorted values, and its width.
std::pair<double, double> widest_gap(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  std::pair<double, double> widest{0, 0};
  for (std::size_t k = 1; k < values.size(); ++k)
    if (const double gap = values[k] - values[k - 1]; gap > widest.second)
      widest = {0.5 * (values[k] + values[k - 1]), gap};
  return widest;
}

/// Where along the axis the sheet is parted, sector by sector; NaN where it is not.
std::array<double, kSectors> partings(const Mesh& sheet, const SurfaceChart& chart) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  std::array<std::vector<double>, kSectors> along;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& p : sheet.vertices) {
    const ChartPoint c = chart.coordinates(p);
    const auto sector = static_cast<int>(kSectors * (c.u / (2 * std::numbers::pi) + 0.5));
    along[static_cast<std::size_t>(std::clamp(sector, 0, kSectors - 1))].push_back(c.v);
    low = std::min(low, c.v), high = std::max(high, c.v);
  }
  std::array<double, kSectors> parted{};
  for (std::size_t k = 0; k < along.size(); ++k) {
    const auto [middle, width] = widest_gap(along[k]);
    const auto below = std::count_if(along[k].begin(), along[k].end(), [m = middle](double v) { return v < m; });
    const auto all = static_cast<std::ptrdiff_t>(along[k].size());
    const bool both = 10 * below > all && 10 * (all - below) > all;
    parted[k] = width > kNotchWidth * (high - low) && both ? middle : kNaN;
  }
  return parted;
}

/// The longest run of sectors [first, last) that are parted.
std::pair<std::size_t, std::size_t> longest_run(const std::array<double, kSectors>& parted) {
  std::pair<std::size_t, std::size_t> best{0, 0};
  for (std::size_t first = 0; first < parted.size();) {
    std::size_t last = first;
    while (last < parted.size() && !std::isnan(parted[last])) ++last;
    if (last - first > best.second - best.first) best = {first, last};
    first = last + 1;
  }
  return best;
}

}  // namespace

std::vector<Zone> arms_of(const Mesh& sheet) {
  const std::vector<OrientedPoint> points = oriented_points(sheet);
  if (!wraps_round(points)) return {};
  const SurfaceChart chart{true, axis_frame(points, normal_axes(points).front())};
  const std::array<double, kSectors> parted = partings(sheet, chart);
  const auto [first, last] = longest_run(parted);
  if (last - first < kMinArmSectors) return {};
  std::vector<Zone> arms;
  for (const bool above : {false, true}) {
    Mesh arm = part_of(sheet, [&, f = first, l = last](const Vec3& centre, const Vec3&) {
      const ChartPoint c = chart.coordinates(centre);
      const auto sector = static_cast<std::size_t>(
          std::clamp(static_cast<int>(kSectors * (c.u / (2 * std::numbers::pi) + 0.5)), 0, kSectors - 1));
      return sector >= f && sector < l && (c.v > parted[sector]) == above;
    });
    arm = largest_sheet(arm);
    if (area_of(arm) < kArmShare * area_of(sheet)) return {};
    arms.push_back({std::move(arm), chart.X_BS.R.col(2), true});
  }
  return arms;
}

std::vector<Zone> find_zones(const Mesh& mesh, const ZoneOptions& options, const std::string& name, Diagnostics& out) {
  const bool one_face = options.facing || !is_closed(mesh);
  if (!one_face && !options.within) {
    out.error(Code::conflict, name,
              "is closed, and a contact surface is one face of it: say which one, by the way it faces or by a "
              "region");
    return {};
  }
  const Mesh part = part_of(mesh, [&](const Vec3& centre, const Vec3& normal) {
    return (!options.facing || normal.dot(options.facing->normalized()) > kFacingCosine) &&
           (!options.within || options.within(centre));
  });
  if (part.empty()) {
    out.error(Code::no_surface, name, "has no triangle there: the region and the direction leave nothing over");
    return {};
  }
  std::vector<Zone> zones;
  for (Mesh& sheet : sheets_of(part, kSheetShare)) {
    std::vector<Zone> arms = options.fork ? arms_of(sheet) : std::vector<Zone>{};
    if (arms.empty()) arms.push_back({std::move(sheet), std::nullopt, true});
    for (Zone& arm : arms) zones.push_back(std::move(arm));
  }
  for (Zone& zone : zones) zone.one_face = one_face;
  sort_by_place(zones);
  if (zones.empty()) out.error(Code::no_surface, name, "is in pieces that are all too small");
  return zones;
}

Mesh zone_round(const Mesh& mesh, const std::vector<Vec3>& points, const std::vector<Vec3>& normals, double reach) {
  const double square = reach * reach;
  const auto near = [&](const Vec3& centre, const Vec3& normal) {
    for (std::size_t k = 0; k < points.size(); ++k)
      if ((centre - points[k]).squaredNorm() <= square && normal.dot(normals[k]) > 0) return true;
    return false;
  };
  std::vector<Mesh> sheets = sheets_of(part_of(mesh, near), 0.01);
  // The sheet that the contacts are on, not one that happens to be larger.
  std::size_t best = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < sheets.size(); ++s) {
    double sum = 0;
    for (const Vec3& p : points) {
      double closest = std::numeric_limits<double>::infinity();
      for (const Vec3& v : sheets[s].vertices) closest = std::min(closest, (v - p).squaredNorm());
      sum += std::sqrt(closest);
    }
    if (sum < nearest) nearest = sum, best = s;
  }
  return sheets.empty() ? Mesh{} : std::move(sheets[best]);
}

}  // namespace genu
