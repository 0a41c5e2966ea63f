// Closed shells and boxes as meshes: what segmentation and CAD give in place of one sheet.
#pragma once

#include <array>
#include <map>
#include <utility>

#include "genu/mesh/mesh.h"

namespace genu::test {

/// A sheet and its back, `thickness` (m) behind it along the vertices' normals, with a wall along every free edge. The
/// sheet's vertices and triangles come first and stay as they are.
inline Mesh thickened(const Mesh& sheet, double thickness) {
  Mesh shell = sheet;
  const int n = static_cast<int>(sheet.vertices.size());
  std::vector<Vec3> normals(sheet.vertices.size(), Vec3::Zero());
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : sheet.triangles) {
    const Vec3 &a = sheet.vertices[at(t[0])], &b = sheet.vertices[at(t[1])], &c = sheet.vertices[at(t[2])];
    for (std::size_t i = 0; i < 3; ++i) {
      normals[at(t[i])] += (b - a).cross(c - a);
      ++edges[{t[i], t[(i + 1) % 3]}];
    }
    shell.triangles.push_back({t[0] + n, t[2] + n, t[1] + n});
  }
  for (std::size_t v = 0; v < sheet.vertices.size(); ++v)
    shell.vertices.push_back(sheet.vertices[v] - thickness * normals[v].normalized());
  for (const auto& [edge, count] : edges) {
    const auto [a, b] = edge;
    if (edges.contains({b, a})) continue;
    shell.triangles.push_back({b, a, a + n});
    shell.triangles.push_back({b, a + n, b + n});
  }
  return shell;
}

/// A box with edges along the axes from `low` to `high` (m), each face in n x n squares of two triangles.
inline Mesh box(const Vec3& low, const Vec3& high, int n) {
  std::map<std::array<int, 3>, int> known;
  Mesh mesh;
  const auto vertex = [&](const std::array<int, 3>& place) {
    const auto [found, fresh] = known.try_emplace(place, static_cast<int>(mesh.vertices.size()));
    if (fresh) {
      Vec3 x;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        x[k] = low[k] + (high[k] - low[k]) * place[i] / n;
      }
      mesh.vertices.push_back(x);
    }
    return found->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int end : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> place{};
            place[axis] = end;
            place[(axis + 1) % 3] = i + di;
            place[(axis + 2) % 3] = j + dj;
            return vertex(place);
          };
          const int a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          const std::array<std::array<int, 3>, 2> out = {{{a, b, c}, {a, c, d}}};
          for (auto t : out) {
            if (end == 0) std::swap(t[1], t[2]);
            mesh.triangles.push_back(t);
          }
        }
  return mesh;
}

}  // namespace genu::test
