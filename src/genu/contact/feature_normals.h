// The side of a mesh that a point lies on, from the normal of its nearest feature: face, edge or vertex.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "genu/contact/tolerances.h"
#include "genu/core/types.h"
#include "genu/mesh/mesh.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/mesh/vertex_triangles.h"

namespace genu {

/// Angle-weighted normals of the faces, edges and vertices of a mesh (Baerentzen and Aanaes 2005): the sign of
/// (x - nearest) . normal is the side of x whatever feature is nearest.
class FeatureNormals {
 public:
  explicit FeatureNormals(const Mesh& mesh)
      : mesh_(mesh), open_vertex_(boundary_vertices(mesh, mesh_edges(mesh))), faces_(mesh) {}

  /// Whether a vertex lies on an edge of the sheet.
  bool open_vertex(std::size_t v) const { return open_vertex_[v]; }
  bool any_open() const { return std::find(open_vertex_.begin(), open_vertex_.end(), true) != open_vertex_.end(); }

  /// The normal of the feature of triangle t that `p` lies on. `open`: it belongs to an edge of the sheet.
  Vec3 at(int triangle, const Vec3& p, bool& open) const {
    const auto& t = mesh_.triangles[static_cast<std::size_t>(triangle)];
    const Vec3 bary = barycentric(t, p);
    int zeros = 0;
    std::size_t zero = 0, one = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (bary[static_cast<Eigen::Index>(k)] <= kOnFeature) ++zeros, zero = k;
      if (bary[static_cast<Eigen::Index>(k)] >= 1 - 2 * kOnFeature) one = k;
    }
    open = false;
    if (zeros == 0) return face_normal(t);
    if (zeros >= 2) {
      open = open_vertex_[static_cast<std::size_t>(t[one])];
      return vertex_normal(t[one]);
    }
    return edge_normal(t[(zero + 1) % 3], t[(zero + 2) % 3], open);
  }

 private:
  const Vec3& vertex(int i) const { return mesh_.vertices[static_cast<std::size_t>(i)]; }

  Vec3 face_normal(const std::array<int, 3>& t) const {
    return (vertex(t[1]) - vertex(t[0])).cross(vertex(t[2]) - vertex(t[0])).normalized();
  }

  /// By the angles of the triangles round it.
  Vec3 vertex_normal(int v) const {
    Vec3 sum = Vec3::Zero();
    for (const int face : faces_.of(v)) {
      const auto& t = mesh_.triangles[genu::at(face)];
      const Vec3 normal = face_normal(t);
      if (!normal.allFinite()) continue;
      const std::size_t c = t[0] == v ? 0 : t[1] == v ? 1 : 2;
      const Vec3 e1 = vertex(t[(c + 1) % 3]) - vertex(v), e2 = vertex(t[(c + 2) % 3]) - vertex(v);
      sum += std::atan2(e1.cross(e2).norm(), e1.dot(e2)) * normal;
    }
    return sum;
  }

  /// The sum over the triangles beside it. `open`: there is only one.
  Vec3 edge_normal(int i, int j, bool& open) const {
    Vec3 sum = Vec3::Zero();
    int beside = 0;
    for (const int face : faces_.of(i)) {
      const auto& t = mesh_.triangles[genu::at(face)];
      if (t[0] != j && t[1] != j && t[2] != j) continue;
      const Vec3 normal = face_normal(t);
      if (!normal.allFinite()) continue;
      sum += normal;
      ++beside;
    }
    open = beside == 1;
    return sum;
  }

  Vec3 barycentric(const std::array<int, 3>& t, const Vec3& p) const {
    const Vec3 e1 = vertex(t[1]) - vertex(t[0]), e2 = vertex(t[2]) - vertex(t[0]), d = p - vertex(t[0]);
    const Vec3 n = e1.cross(e2);
    const double area2 = n.squaredNorm();
    const double b1 = d.cross(e2).dot(n) / area2, b2 = e1.cross(d).dot(n) / area2;
    return {1 - b1 - b2, b1, b2};
  }

  const Mesh& mesh_;
  std::vector<bool> open_vertex_;
  VertexTriangles faces_;
};

}  // namespace genu
