// The faces of voxels: the surface of a segmentation that was not smoothed.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "genu/mesh/mesh.h"

namespace genu::test {

/// The faces between voxels of the given edges (m) whose middles are inside and those that are not, within |x| <=
/// reach.
inline Mesh voxel_faces(const std::function<bool(const Vec3&)>& inside, const Vec3& edges, double reach) {
  Mesh mesh;
  std::map<std::array<int, 3>, int> known;
  std::array<int, 3> count{};
  for (std::size_t i = 0; i < 3; ++i)
    count[i] = static_cast<int>(std::ceil(reach / edges[static_cast<Eigen::Index>(i)]));
  const auto filled = [&](const std::array<int, 3>& c) {
    return inside(Vec3((c[0] + 0.5) * edges[0], (c[1] + 0.5) * edges[1], (c[2] + 0.5) * edges[2]));
  };
  const auto vertex = [&](const std::array<int, 3>& c) {
    const auto [found, fresh] = known.try_emplace(c, static_cast<int>(mesh.vertices.size()));
    if (fresh) mesh.vertices.emplace_back(c[0] * edges[0], c[1] * edges[1], c[2] * edges[2]);
    return found->second;
  };
  const auto add_face = [&](std::array<int, 3> c, std::size_t axis, bool outward) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::array<int, 4> corner{};
    for (std::size_t k = 0; k < 4; ++k) {
      std::array<int, 3> at = c;
      at[u] += k == 1 || k == 2 ? 1 : 0;
      at[v] += k >= 2 ? 1 : 0;
      corner[k] = vertex(at);
    }
    if (!outward) std::swap(corner[1], corner[3]);
    mesh.triangles.push_back({corner[0], corner[1], corner[2]});
    mesh.triangles.push_back({corner[0], corner[2], corner[3]});
  };
  for (int i = -count[0]; i < count[0]; ++i)
    for (int j = -count[1]; j < count[1]; ++j)
      for (int k = -count[2]; k < count[2]; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const std::array<int, 3> here{i, j, k};
          std::array<int, 3> next = here;
          ++next[axis];
          if (filled(here) != filled(next)) add_face(next, axis, filled(here));
        }
  return mesh;
}

}  // namespace genu::test
