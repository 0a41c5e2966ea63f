#include "genu/store/report_wraps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include <Eigen/Geometry>

namespace genu {
namespace {

using GridCell = std::array<std::int64_t, 3>;

GridCell cell_of(const Vec3& p, double edge) {
  return {std::llround(p.x() / edge), std::llround(p.y() / edge), std::llround(p.z() / edge)};
}

/// Places by cells as wide as the distance that is asked for.
class NearPlaces {
 public:
  NearPlaces(const std::vector<Vec3>& places, double distance) : distance_(distance) {
    for (const Vec3& p : places) cells_[cell_of(p, distance)].push_back(p);
  }

  bool operator()(const Vec3& p) const {
    const GridCell middle = cell_of(p, distance_);
    for (std::int64_t i = -1; i <= 1; ++i)
      for (std::int64_t j = -1; j <= 1; ++j)
        for (std::int64_t k = -1; k <= 1; ++k) {
          const auto cell = cells_.find({middle[0] + i, middle[1] + j, middle[2] + k});
          if (cell == cells_.end()) continue;
          for (const Vec3& place : cell->second)
            if ((place - p).norm() <= distance_) return true;
        }
    return false;
  }

 private:
  double distance_;
  std::map<GridCell, std::vector<Vec3>> cells_;
};

}  // namespace

std::vector<bool> only_wrapped(const PlacedScene& scene) {
  std::vector<bool> wrapped(scene.surfaces.size());
  for (const LigamentDef& l : scene.ligaments)
    for (const WrapDef& w : l.wraps) wrapped[at(w.surface)] = true;
  for (const LoadDef& l : scene.loads)
    for (const WrapDef& w : l.wraps) wrapped[at(w.surface)] = true;
  const auto in_contact = [&](const ContactDef& c) {
    wrapped[at(c.surface_a)] = false;
    wrapped[at(c.surface_b)] = false;
  };
  for (const ContactDef& c : scene.contacts) in_contact(c);
  for (const LayerDef& l : scene.layers) in_contact(l.pair);
  std::vector<bool> more(scene.bodies.size());
  for (std::size_t b = 0; b < more.size(); ++b) more[b] = scene.bodies[b].solid.has_value();
  for (std::size_t i = 0; i < wrapped.size(); ++i)
    if (!wrapped[i]) more[at(scene.surfaces[i].body)] = true;
  for (std::size_t i = 0; i < wrapped.size(); ++i) wrapped[i] = wrapped[i] && more[at(scene.surfaces[i].body)];
  return wrapped;
}

std::vector<Vec3> places_of_paths(const ReportRun& run, int body, const Surface& surface) {
  constexpr double kCell = 2e-3;       // m: as fine as what is kept round each place is wide
  constexpr double kOnSurface = 5e-4;  // m: of a course that is drawn on it
  std::map<GridCell, Vec3> found;
  for (const auto* paths : {&run.wrapped, &run.cables})
    for (const ReportPath& path : *paths)
      for (const auto& row : path.rows)
        for (const ReportPath::Point& point : row)
          if (point.body == body) found.emplace(cell_of(point.p, kCell), point.p);
  std::vector<Vec3> out;
  for (const auto& [cell, p] : found)
    if (const auto gap = surface.gap(p); gap && std::abs(*gap) <= kOnSurface) out.push_back(p);
  return out;
}

void keep_near_places(Mesh& mesh, const std::vector<Vec3>& places, double distance) {
  const NearPlaces near(places, distance);
  std::vector<bool> kept(mesh.vertices.size());
  std::transform(mesh.vertices.begin(), mesh.vertices.end(), kept.begin(), near);
  std::erase_if(mesh.triangles, [&](const auto& t) { return !kept[at(t[0])] && !kept[at(t[1])] && !kept[at(t[2])]; });
  std::vector<int> number(mesh.vertices.size(), -1);
  std::vector<Vec3> used;
  for (auto& t : mesh.triangles)
    for (int& v : t) {
      int& here = number[at(v)];
      if (here < 0) {
        here = static_cast<int>(used.size());
        used.push_back(mesh.vertices[at(v)]);
      }
      v = here;
    }
  mesh.vertices = std::move(used);
}

void cut_wrapped(const Prepared& p, ReportRun& run) {
  constexpr double kMargin = 6e-3;  // m: so much round a path shows the curve
  const std::vector<bool> cut = only_wrapped(p.scene);
  for (std::size_t i = 0; i < cut.size(); ++i) {
    if (!cut[i]) continue;
    ReportMesh& shown = run.meshes[i];
    shown.kind = ReportMesh::Kind::wrapped;
    const std::vector<Vec3> touched = places_of_paths(run, shown.body, *p.surfaces[i]);
    if (touched.empty()) continue;
    Mesh mesh;
    if (p.scene.surfaces[i].shape == SurfaceDef::Shape::mesh) {
      mesh.vertices = std::move(shown.vertices);
      mesh.triangles = std::move(shown.triangles);
    } else {
      Eigen::AlignedBox3d box;
      for (const Vec3& place : touched) box.extend(place);
      mesh = p.surfaces[i]->triangles(kMargin / 3, box.center(), box.diagonal().norm() / 2 + kMargin);
    }
    keep_near_places(mesh, touched, kMargin);
    shown.vertices = std::move(mesh.vertices);
    shown.triangles = std::move(mesh.triangles);
    shown.triangles_in_full = shown.triangles.size();
  }
}

}  // namespace genu
