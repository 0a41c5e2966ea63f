#include "genu/mesh_care/mesh_intersections.h"

#ifdef GENU_WITH_CGAL
#include <algorithm>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include "genu/mesh/mesh_topology.h"

namespace genu {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

bool is_usable(const Mesh& mesh) {
  const int count = static_cast<int>(mesh.vertices.size());
  const auto names_vertex = [count](int v) { return v >= 0 && v < count; };
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](const Vec3& v) { return v.allFinite(); }) &&
         std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
           return std::all_of(t.begin(), t.end(), names_vertex) && t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
         });
}

/// CGAL wants neighbours to be wound alike.
std::optional<SurfaceMesh> to_surface_mesh(Mesh mesh) {
  if (!is_usable(mesh)) return std::nullopt;
  make_winding_consistent(mesh, mesh_edges(mesh));
  std::vector<Kernel::Point_3> points;
  points.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) points.emplace_back(v.x(), v.y(), v.z());
  std::vector<std::vector<std::size_t>> polygons;
  polygons.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) polygons.emplace_back(t.begin(), t.end());
  if (!pmp::is_polygon_soup_a_polygon_mesh(polygons)) return std::nullopt;
  SurfaceMesh out;
  pmp::polygon_soup_to_polygon_mesh(points, polygons, out);
  return out;
}

}  // namespace

bool built_with_cgal() { return true; }

std::optional<std::size_t> count_self_intersections(const Mesh& mesh) {
  const std::optional<SurfaceMesh> surface = to_surface_mesh(mesh);
  if (!surface) return std::nullopt;
  using Face = SurfaceMesh::Face_index;
  std::vector<std::pair<Face, Face>> pairs;
  pmp::self_intersections(*surface, std::back_inserter(pairs));
  // A triangle without area is listed as a pair with itself.
  const auto crossing = [](const auto& pair) { return pair.first != pair.second; };
  return static_cast<std::size_t>(std::count_if(pairs.begin(), pairs.end(), crossing));
}

}  // namespace genu

#else  // GENU_WITH_CGAL

namespace genu {

bool built_with_cgal() { return false; }

std::optional<std::size_t> count_self_intersections(const Mesh&) { return std::nullopt; }

}  // namespace genu

#endif  // GENU_WITH_CGAL
