// The side of a mesh that a point lies on, from the normal of its nearest feature: face, edge or vertex.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "genu/contact/tolerances.h"
#include "genu/core/types.h"
#include "genu/mesh/mesh.h"

namespace genu {

/// Angle-weighted normals of the faces, edges and vertices of a mesh (Baerentzen and Aanaes 2005): the sign of
/// (x - nearest) . normal is the side of x whatever feature is nearest.
class FeatureNormals {
 public:
  explicit FeatureNormals(const Mesh& mesh)
      : mesh_(mesh), vertex_(mesh.vertices.size(), Vec3::Zero()), open_vertex_(mesh.vertices.size(), false) {
    edges_.reserve(3 * mesh.triangles.size());
    for (const auto& t : mesh.triangles) add_triangle(t);
    join_edges();
    for (const Edge& edge : edges_) {
      if (edge.faces != 1) continue;
      open_vertex_[static_cast<std::size_t>(edge.i)] = open_vertex_[static_cast<std::size_t>(edge.j)] = true;
    }
  }

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
      const auto v = static_cast<std::size_t>(t[one]);
      open = open_vertex_[v];
      return vertex_[v];
    }
    const Edge& edge = edge_between(t[(zero + 1) % 3], t[(zero + 2) % 3]);
    open = edge.faces == 1;
    return edge.normal;
  }

 private:
  struct Edge {
    int i, j;  // i < j
    Vec3 normal;
    int faces;
    bool operator<(const Edge& other) const { return std::pair(i, j) < std::pair(other.i, other.j); }
  };

  const Edge& edge_between(int i, int j) const {
    return *std::lower_bound(edges_.begin(), edges_.end(), Edge{std::min(i, j), std::max(i, j), {}, 0});
  }

  /// Sorts the sides of all triangles and merges equal edges.
  void join_edges() {
    std::stable_sort(edges_.begin(), edges_.end());
    std::size_t last = 0;
    for (std::size_t k = 1; k < edges_.size(); ++k) {
      if (!(edges_[last] < edges_[k])) {
        edges_[last].normal += edges_[k].normal;
        ++edges_[last].faces;
      } else {
        edges_[++last] = edges_[k];
      }
    }
    if (!edges_.empty()) edges_.erase(edges_.begin() + static_cast<std::ptrdiff_t>(last) + 1, edges_.end());
    edges_.shrink_to_fit();
  }

  const Vec3& vertex(int i) const { return mesh_.vertices[static_cast<std::size_t>(i)]; }

  Vec3 face_normal(const std::array<int, 3>& t) const {
    return (vertex(t[1]) - vertex(t[0])).cross(vertex(t[2]) - vertex(t[0])).normalized();
  }

  void add_triangle(const std::array<int, 3>& t) {
    const Vec3 normal = face_normal(t);
    if (!normal.allFinite()) return;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 e1 = vertex(t[(k + 1) % 3]) - vertex(t[k]), e2 = vertex(t[(k + 2) % 3]) - vertex(t[k]);
      vertex_[static_cast<std::size_t>(t[k])] += std::atan2(e1.cross(e2).norm(), e1.dot(e2)) * normal;
      const int i = t[k], j = t[(k + 1) % 3];
      edges_.push_back({std::min(i, j), std::max(i, j), normal, 1});
    }
  }

  Vec3 barycentric(const std::array<int, 3>& t, const Vec3& p) const {
    const Vec3 e1 = vertex(t[1]) - vertex(t[0]), e2 = vertex(t[2]) - vertex(t[0]), d = p - vertex(t[0]);
    const Vec3 n = e1.cross(e2);
    const double area2 = n.squaredNorm();
    const double b1 = d.cross(e2).dot(n) / area2, b2 = e1.cross(d).dot(n) / area2;
    return {1 - b1 - b2, b1, b2};
  }

  const Mesh& mesh_;
  std::vector<Vec3> vertex_;
  std::vector<bool> open_vertex_;
  std::vector<Edge> edges_;  // by (i, j)
};

}  // namespace genu
