#include "genu/results/report_pressures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>

#include "genu/model/layer_report.h"
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
  std::vector<SideMap> maps;
  std::size_t samples = 0;
  for (std::size_t k = 0; k < model.layers.size(); ++k) {
    const JointModel::Layer& layer = model.layers[k];
    const ContactDef& pair = scene.layers[k].pair;
    const auto& sides = layer.layer->sides();
    ElasticLayer::Memory memory;
    std::vector<SideMap> own;
    for (const ElasticLayer::Side& side : sides) {
      const int surface = side.a ? pair.surface_a : pair.surface_b;
      ReportPressure map;
      map.contact = pair.name;
      map.surface = scene.surfaces[at(surface)].name;
      map.body = side.a ? layer.body_a : layer.body_b;
      if (shown_whole(scene, meshes, surface)) map.mesh = surface;
      own.emplace_back(std::move(map));
    }
    for (const State* state : states)
      for (std::size_t i = 0; i < own.size(); ++i) {
        own[i].begin_row();
        if (state == nullptr) continue;
        const auto add = [&](const LayerPoint& point) { own[i].add(point); };
        layer.layer->visit(state->poses[at(layer.body_a)], state->poses[at(layer.body_b)], i, memory, add,
                           state->layer_level(k));
      }
    for (SideMap& map : own) {
      samples += map.samples();
      maps.push_back(std::move(map));
    }
  }
  std::vector<ReportPressure> out;
  for (SideMap& map : maps) {
    if (samples > most) map.thin((samples + most - 1) / most);
    if (map.samples() > 0) out.push_back(map.take());
  }
  return out;
}

}  // namespace genu
