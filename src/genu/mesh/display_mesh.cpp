#include "genu/mesh/display_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

namespace genu {
namespace {

struct Cell {
  Vec3 sum = Vec3::Zero();
  int count = 0;
  int nearest = -1;
  double distance = std::numeric_limits<double>::infinity();
};

/// Of the longest side of a mesh's box: a key has 21 bits for each axis.
constexpr double kLeastCell = 1e-6;

double longest_side(const Mesh& mesh) {
  Vec3 low = mesh.vertices.front(), high = low;
  for (const Vec3& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  return std::max((high - low).maxCoeff(), std::numeric_limits<double>::min());
}

/// For each vertex the cell it lies in; cells are numbered by first appearance.
std::vector<int> cells_of(const Mesh& mesh, double edge, std::vector<Cell>& cells) {
  Vec3 low = mesh.vertices.front();
  for (const Vec3& v : mesh.vertices) low = low.cwiseMin(v);
  std::unordered_map<std::uint64_t, int> numbers;
  std::vector<int> cell(mesh.vertices.size());
  for (std::size_t i = 0; i < cell.size(); ++i) {
    constexpr int kBits = 21;
    std::uint64_t key = 0;
    for (Eigen::Index k = 0; k < 3; ++k)
      key = key << kBits | static_cast<std::uint64_t>((mesh.vertices[i][k] - low[k]) / edge);
    cell[i] = numbers.emplace(key, static_cast<int>(cells.size())).first->second;
    if (at(cell[i]) == cells.size()) cells.emplace_back();
    cells[at(cell[i])].sum += mesh.vertices[i];
    ++cells[at(cell[i])].count;
  }
  return cell;
}

Mesh clustered(const Mesh& mesh, double edge) {
  std::vector<Cell> cells;
  const std::vector<int> cell = cells_of(mesh, edge, cells);
  for (std::size_t i = 0; i < cell.size(); ++i) {
    Cell& c = cells[at(cell[i])];
    const double distance = (mesh.vertices[i] - c.sum / c.count).squaredNorm();
    if (distance >= c.distance) continue;
    c.distance = distance;
    c.nearest = static_cast<int>(i);
  }
  Mesh out;
  for (const Cell& c : cells) out.vertices.push_back(mesh.vertices[at(c.nearest)]);
  for (const auto& t : mesh.triangles) {
    const std::array<int, 3> drawn{cell[at(t[0])], cell[at(t[1])], cell[at(t[2])]};
    if (drawn[0] != drawn[1] && drawn[1] != drawn[2] && drawn[2] != drawn[0]) out.triangles.push_back(drawn);
  }
  return out;
}

}  // namespace

Mesh display_mesh(Mesh mesh, std::size_t most) {
  constexpr std::size_t kFew = 1000;
  most = std::max(most, kFew);
  if (mesh.triangles.size() <= most) return mesh;
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[at(t[0])];
    area += (mesh.vertices[at(t[1])] - a).cross(mesh.vertices[at(t[2])] - a).norm() / 2;
  }
  // A cell of this side meets about edge^2 of the surface, and two triangles stand for it.
  constexpr double kMore = 1.15;
  double edge = std::max(std::sqrt(2 * area / static_cast<double>(most)), kLeastCell * longest_side(mesh));
  for (;; edge *= kMore) {
    Mesh out = clustered(mesh, edge);
    if (out.triangles.size() <= most) return out;
  }
}

}  // namespace genu
