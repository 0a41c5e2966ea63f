#include "genu/surface/samples.h"

#include <algorithm>
#include <utility>

#include "genu/mesh/cell_lists.h"
#include "genu/surface/tolerances.h"

namespace genu {

namespace {

bool same_side(const SampleSet& set, std::size_t i, std::size_t j) {
  return set.normals[i].dot(set.normals[j]) > kSameSideCosine;
}

/// For each sample the kept one it belongs to, as an index into `kept`.
std::vector<int> choose_kept(const SampleSet& set, const CellLists& cells, double spacing, std::vector<int>& kept) {
  std::vector<int> owner(set.points.size(), -1);
  std::vector<double> nearest(set.points.size(), spacing * spacing);
  for (std::size_t i = 0; i < set.points.size(); ++i) {
    if (owner[i] >= 0) continue;
    owner[i] = static_cast<int>(kept.size());
    nearest[i] = 0;
    for (const int j : cells.at(set.points[i])) {
      const double square = (set.points[at(j)] - set.points[i]).squaredNorm();
      if (square >= nearest[at(j)] || !same_side(set, i, at(j))) continue;
      nearest[at(j)] = square;
      owner[at(j)] = static_cast<int>(kept.size());
    }
    kept.push_back(static_cast<int>(i));
  }
  return owner;
}

}  // namespace

SampleSet vertex_samples(const Mesh& mesh) {
  SampleSet out;
  const std::size_t n = mesh.vertices.size();
  out.points = mesh.vertices;
  out.normals.assign(n, Vec3::Zero());
  out.areas.assign(n, 0.0);
  std::vector<std::pair<int, int>> edges;
  edges.reserve(6 * mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    const Vec3& p = mesh.vertices[static_cast<std::size_t>(t[0])];
    const Vec3 cross =
        (mesh.vertices[static_cast<std::size_t>(t[1])] - p).cross(mesh.vertices[static_cast<std::size_t>(t[2])] - p);
    for (int k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(t[static_cast<std::size_t>(k)]);
      out.normals[v] += cross;
      out.areas[v] += cross.norm() / 6;
      const int next = t[static_cast<std::size_t>((k + 1) % 3)];
      edges.emplace_back(static_cast<int>(v), next);
      edges.emplace_back(next, static_cast<int>(v));
    }
  }
  for (Vec3& normal : out.normals) normal.normalize();
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  out.first_neighbour.assign(n + 1, 0);
  for (const auto& e : edges) ++out.first_neighbour[static_cast<std::size_t>(e.first) + 1];
  for (std::size_t i = 0; i < n; ++i) out.first_neighbour[i + 1] += out.first_neighbour[i];
  out.neighbours.reserve(edges.size());
  for (const auto& e : edges) out.neighbours.push_back(e.second);
  return out;
}

SampleSet thin_samples(const SampleSet& set, double spacing) {
  std::vector<int> kept;
  const CellLists cells(set.points, std::span(&spacing, 1), spacing);
  const std::vector<int> owner = choose_kept(set, cells, spacing, kept);
  SampleSet out;
  for (const int i : kept) {
    out.points.push_back(set.points[at(i)]);
    out.normals.push_back(set.normals[at(i)]);
  }
  out.areas.assign(kept.size(), 0.0);
  for (std::size_t i = 0; i < owner.size(); ++i) out.areas[at(owner[i])] += set.areas[i];
  const double reach = 2 * spacing;
  const CellLists near(out.points, std::span(&reach, 1), spacing);
  out.first_neighbour.push_back(0);
  for (std::size_t i = 0; i < out.points.size(); ++i) {
    for (const int j : near.at(out.points[i])) {
      const bool close = (out.points[at(j)] - out.points[i]).squaredNorm() < reach * reach;
      if (at(j) != i && close && same_side(out, i, at(j))) out.neighbours.push_back(j);
    }
    out.first_neighbour.push_back(static_cast<int>(out.neighbours.size()));
  }
  return out;
}

}  // namespace genu
