// What scanners, segmentation and exporters do to meshes, done on purpose at a known place.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "genu/core/pose.h"
#include "genu/geometry/mesh.h"
#include "genu/geometry/mesh_topology.h"

namespace genu::test {

enum class Dirt { fin, flipped, duplicate, hole, crossing, stray, spike, slivers };

inline const char* name_of(Dirt dirt) {
  constexpr const char* kNames[] = {"fin", "flipped", "duplicate", "hole", "crossing", "stray", "spike", "slivers"};
  return kNames[static_cast<int>(dirt)];
}

/// Does it take the surface away, or put something in its way? Otherwise reading mends it.
inline bool is_serious(Dirt dirt) { return dirt != Dirt::flipped && dirt != Dirt::duplicate && dirt != Dirt::slivers; }

inline int nearest_vertex(const Mesh& mesh, const Vec3& place) {
  int nearest = 0;
  for (int v = 1; v < static_cast<int>(mesh.vertices.size()); ++v)
    if ((mesh.vertices[static_cast<std::size_t>(v)] - place).norm() <
        (mesh.vertices[static_cast<std::size_t>(nearest)] - place).norm())
      nearest = v;
  return nearest;
}

/// Triangles whose middle is within `radius` (m) of the place.
inline std::vector<std::size_t> triangles_near(const Mesh& mesh, const Vec3& place, double radius) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Vec3 middle = Vec3::Zero();
    for (const int v : mesh.triangles[i]) middle += mesh.vertices[static_cast<std::size_t>(v)] / 3;
    if ((middle - place).norm() < radius) out.push_back(i);
  }
  return out;
}

/// The mesh with dirt about `radius` (m) wide at a vertex near `place`.
inline Mesh dirtied(Mesh mesh, Dirt dirt, const Vec3& place, double radius) {
  const int v = nearest_vertex(mesh, place);
  const Vec3 p = mesh.vertices[static_cast<std::size_t>(v)];
  const Vec3 n = vertex_normals(mesh)[static_cast<std::size_t>(v)];
  const std::vector<std::size_t> near = triangles_near(mesh, p, radius);
  const int fresh = static_cast<int>(mesh.vertices.size());
  switch (dirt) {
    case Dirt::fin:
      for (const std::size_t i : near) {
        const auto t = mesh.triangles[i];
        mesh.triangles.push_back({t[0], t[1], static_cast<int>(mesh.vertices.size())});
        mesh.vertices.push_back(Vec3(mesh.vertices[static_cast<std::size_t>(t[0])] + 0.5 * radius * n));
      }
      break;
    case Dirt::flipped:
      for (const std::size_t i : near) std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
      break;
    case Dirt::duplicate:
      for (const std::size_t i : near) mesh.triangles.push_back(std::array<int, 3>(mesh.triangles[i]));
      break;
    case Dirt::hole: {
      std::vector<char> gone(mesh.triangles.size(), 0);
      for (const std::size_t i : near) gone[i] = 1;
      std::size_t index = 0;
      std::erase_if(mesh.triangles, [&](const auto&) { return gone[index++] != 0; });
      break;
    }
    case Dirt::crossing: {
      const Mat3 tilt = exp_rotation(0.7 * n.unitOrthogonal());
      for (const std::size_t i : near) {
        const auto t = mesh.triangles[i];
        const int first = static_cast<int>(mesh.vertices.size());
        for (const int w : t)
          mesh.vertices.push_back(Vec3(p + tilt * (mesh.vertices[static_cast<std::size_t>(w)] - p)));
        mesh.triangles.push_back({first, first + 1, first + 2});
      }
      break;
    }
    case Dirt::stray: {
      const Vec3 c = p + 0.6 * radius * n;
      const double s = 0.3 * radius;
      for (int k = 0; k < 3; ++k) {
        mesh.vertices.push_back(Vec3(c + s * Vec3::Unit(k)));
        mesh.vertices.push_back(Vec3(c - s * Vec3::Unit(k)));
      }
      for (const auto& t :
           {std::array{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}})
        mesh.triangles.push_back({fresh + t[0], fresh + t[1], fresh + t[2]});
      break;
    }
    case Dirt::spike:
      mesh.vertices[static_cast<std::size_t>(v)] += radius * n;
      break;
    case Dirt::slivers:
      // A point very near a corner of each triangle, joined to all three corners.
      for (const std::size_t i : near) {
        const auto t = mesh.triangles[i];
        const auto corner = [&](std::size_t k) -> Vec3 { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
        const int w = static_cast<int>(mesh.vertices.size());
        mesh.vertices.push_back(Vec3(0.98 * corner(0) + 0.01 * corner(1) + 0.01 * corner(2)));
        mesh.triangles[i] = {t[0], t[1], w};
        mesh.triangles.push_back({t[1], t[2], w});
        mesh.triangles.push_back({t[2], t[0], w});
      }
      break;
  }
  return mesh;
}

}  // namespace genu::test
