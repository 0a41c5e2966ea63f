#include "genu/mesh/mesh_part.h"

#include <algorithm>
#include <numeric>

#include <Eigen/Geometry>

#include "genu/mesh/mesh_topology.h"

namespace genu {
namespace {

Vec3 twice_area(const Mesh& mesh, const std::array<int, 3>& t) {
  const auto corner = [&](std::size_t k) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0));
}

/// Drops vertices that no triangle uses; the others keep their order.
void drop_unused(Mesh& mesh) {
  std::vector<int> number(mesh.vertices.size(), -1);
  for (const auto& t : mesh.triangles)
    for (const int v : t) number[static_cast<std::size_t>(v)] = 0;
  std::vector<Vec3> kept;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    number[v] = static_cast<int>(kept.size());
    kept.push_back(mesh.vertices[v]);
  }
  for (auto& t : mesh.triangles)
    for (int& v : t) v = number[static_cast<std::size_t>(v)];
  mesh.vertices = std::move(kept);
}

Mesh component(const Mesh& mesh, const Components& components, int which) {
  Mesh out{mesh.vertices, {}};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (components.of_triangle[t] == which) out.triangles.push_back(mesh.triangles[t]);
  drop_unused(out);
  return out;
}

}  // namespace

Mesh part_of(const Mesh& mesh, const std::function<bool(const Vec3& centre, const Vec3& normal)>& keep) {
  Mesh out{mesh.vertices, {}};
  for (const auto& t : mesh.triangles) {
    const Vec3 normal = twice_area(mesh, t);
    const double length = normal.norm();
    if (!(length > 0)) continue;
    Vec3 centre = Vec3::Zero();
    for (const int v : t) centre += mesh.vertices[static_cast<std::size_t>(v)] / 3;
    if (keep(centre, normal / length)) out.triangles.push_back(t);
  }
  drop_unused(out);
  return out;
}

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles) area += 0.5 * twice_area(mesh, t).norm();
  return area;
}

std::vector<Mesh> sheets_of(const Mesh& mesh, double least_share) {
  const Components components = connected_components(mesh);
  std::vector<double> area(static_cast<std::size_t>(components.count), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    area[static_cast<std::size_t>(components.of_triangle[t])] += 0.5 * twice_area(mesh, mesh.triangles[t]).norm();
  const double all = std::accumulate(area.begin(), area.end(), 0.0);
  std::vector<int> chosen;
  for (int c = 0; c < components.count; ++c)
    if (area[static_cast<std::size_t>(c)] >= least_share * all) chosen.push_back(c);
  std::stable_sort(chosen.begin(), chosen.end(),
                   [&](int a, int b) { return area[static_cast<std::size_t>(a)] > area[static_cast<std::size_t>(b)]; });
  std::vector<Mesh> sheets;
  for (const int c : chosen) sheets.push_back(component(mesh, components, c));
  return sheets;
}

Mesh largest_sheet(const Mesh& mesh) {
  constexpr double kHalf = 0.5;
  std::vector<Mesh> sheets = sheets_of(mesh, kHalf);
  for (double share = kHalf; sheets.empty() && share > 1e-6; share *= kHalf) sheets = sheets_of(mesh, share);
  return sheets.empty() ? Mesh{} : std::move(sheets.front());
}

}  // namespace genu
