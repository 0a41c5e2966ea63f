// The triangles of a mesh in a tree of boxes, for rays: what a layer's depth is measured with.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "genu/geometry/mesh.h"

namespace genu {

class TriangleTree {
 public:
  /// A triangle met by a ray.
  struct Hit {
    int triangle = -1;    ///< index into the mesh, -1: none
    double distance = 0;  ///< m along the ray
    explicit operator bool() const { return triangle >= 0; }
  };

  TriangleTree() = default;
  explicit TriangleTree(const Mesh& mesh);

  /// The nearest triangle at 0 < distance <= length whose outward side the ray comes out of (normal . direction > 0);
  /// of several at one distance the first of the mesh. Exact at edges: no ray passes between two triangles that share
  /// one. `hint`: a triangle that is likely to be met, which makes the answer faster and never another one.
  /// `direction` is a unit vector.
  Hit leaving(const Vec3& origin, const Vec3& direction, double length, int hint = -1) const;

  /// The same for triangles whose outward side the ray enters (normal . direction < 0).
  Hit entering(const Vec3& origin, const Vec3& direction, double length) const;

  /// The first of `margins` (m, falling) such that no triangle lies within it of the segment, surely; their number
  /// where there is none. `met` becomes a triangle that is near, and given again makes the answer faster.
  std::size_t clear_by(const Vec3& origin, const Vec3& direction, double length, std::span<const double> margins,
                       int& met) const;

  /// Corners of a triangle (m) and its area vector: outward, as long as the area is large (m^2).
  const std::array<Vec3, 3>& corners(int triangle) const { return corners_[place(triangle)]; }
  const Vec3& area_vector(int triangle) const { return areas_[place(triangle)]; }

  int size() const { return static_cast<int>(corners_.size()); }

 private:
  struct Node {
    Vec3 low, high;
    int first = 0, last = 0;  ///< triangles, in the tree's order
    int children = -1;        ///< index of the first of two; -1 for a leaf
  };

  std::size_t place(int triangle) const { return static_cast<std::size_t>(place_[static_cast<std::size_t>(triangle)]); }
  void build();
  void split(int node);
  struct Line;
  void meet(std::size_t k, const Line& line, double side, Hit& best) const;
  void search(const Line& line, double side, Hit& best) const;

  std::vector<std::array<Vec3, 3>> corners_;  // in the tree's order
  std::vector<Vec3> areas_;
  std::vector<int> triangle_;  // of the mesh, in the tree's order
  std::vector<int> place_;     // the other way round
  std::vector<Node> nodes_;    // the root first
};

}  // namespace genu
