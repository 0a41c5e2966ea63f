#include "genu/results/report_pressures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>

#include "genu/results/casting_sides.h"
#include "genu/results/tolerances.h"

namespace genu {
namespace {

/// Samples of one casting surface, row after row.
class SideMap {
 public:
  explicit SideMap(ReportPressure map) : map_(std::move(map)) {}

  void begin_row() {
    map_.rows.emplace_back();
    in_row_.clear();
  }

  void add(const LayerPoint& point) {
    if (!(point.pressure > 0)) return;
    const int site = map_.mesh >= 0 ? site_of_triangle(point.cell) : point.area > 0 ? site_of_place(point) : -1;
    if (site < 0) return;
    auto& row = map_.rows.back();
    const auto [place, fresh] = in_row_.emplace(site, row.size());
    if (fresh)
      row.push_back({site, point.pressure});
    else
      row[place->second].pressure = std::max(row[place->second].pressure, point.pressure);
  }

  std::size_t samples() const {
    std::size_t sum = 0;
    for (const auto& row : map_.rows) sum += row.size();
    return sum;
  }

  /// Keeps the samples of every `every`-th row alone.
  void thin(std::size_t every) {
    map_.every = every;
    for (std::size_t row = 0; row < map_.rows.size(); ++row)
      if (row % every != 0) map_.rows[row].clear();
  }

  ReportPressure take() { return std::move(map_); }

 private:
  int site_of_triangle(int triangle) {
    const auto [place, fresh] = triangles_.emplace(triangle, static_cast<int>(map_.triangles.size()));
    if (fresh) map_.triangles.push_back(triangle);
    return place->second;
  }

  /// A node of the lattice is the same place in every row, up to rounding.
  int site_of_place(const LayerPoint& point) {
    std::array<std::int64_t, 3> key{};
    for (Eigen::Index i = 0; i < 3; ++i) key[at(static_cast<int>(i))] = std::llround(point.x[i] / kSameSite);
    const double radius = std::sqrt(point.area / std::numbers::pi);
    const auto [place, fresh] = places_.emplace(key, static_cast<int>(map_.places.size()));
    if (fresh) {
      map_.places.push_back(point.x);
      map_.radii.push_back(radius);
    }
    // At the edge of the contact a node has a part of its area.
    double& largest = map_.radii[at(place->second)];
    largest = std::max(largest, radius);
    return place->second;
  }

  ReportPressure map_;
  std::map<int, std::size_t> in_row_;  ///< of a site, its sample
  std::map<int, int> triangles_;
  std::map<std::array<std::int64_t, 3>, int> places_;
};

/// Whether the triangles that are shown are those of the surface's own mesh.
bool shown_whole(const PlacedScene& scene, const std::vector<ReportMesh>& meshes, int surface) {
  return scene.surfaces[at(surface)].shape == SurfaceDef::Shape::mesh &&
         meshes[at(surface)].triangles.size() == meshes[at(surface)].triangles_in_full;
}

}  // namespace

std::vector<ReportPressure> report_pressures(const PlacedScene& scene, const JointModel& model,
                                             const std::vector<const State*>& states,
                                             const std::vector<ReportMesh>& meshes, std::size_t most) {
  const std::vector<CastingSide> sides = casting_sides(scene, model);
  std::vector<SideMap> maps;
  for (const CastingSide& side : sides) {
    ReportPressure map;
    map.contact = scene.layers[side.layer].pair.name;
    map.surface = scene.surfaces[at(side.surface)].name;
    map.body = side.body;
    if (shown_whole(scene, meshes, side.surface)) map.mesh = side.surface;
    maps.emplace_back(std::move(map));
  }
  std::vector<ElasticLayer::Memory> memories;
  for (const State* state : states)
    for (std::size_t i = 0; i < maps.size(); ++i) {
      maps[i].begin_row();
      if (state != nullptr)
        visit_side(model, sides[i], state->poses, memories, state->layer_level(sides[i].layer),
                   [&](const LayerPoint& point) { maps[i].add(point); });
    }
  std::size_t samples = 0;
  for (const SideMap& map : maps) samples += map.samples();
  std::vector<ReportPressure> out;
  for (SideMap& map : maps) {
    if (samples > most) map.thin((samples + most - 1) / most);
    if (map.samples() > 0) out.push_back(map.take());
  }
  return out;
}

}  // namespace genu
