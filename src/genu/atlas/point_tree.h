// Points with normals, and which of them is nearest to another in place and direction at once.
#pragma once

#include <span>
#include <vector>

#include "genu/mesh/mesh.h"

namespace genu {

struct FacingPoint {
  Vec3 at = Vec3::Zero();      ///< m
  Vec3 normal = Vec3::Zero();  ///< unit, outward
};

/// Vertices with the mean normals of their triangles, at most `most`, evenly from the mesh's list; vertices of no
/// triangle are left out.
std::vector<FacingPoint> facing_vertices(const Mesh& mesh, std::size_t most);

/// Minimises |p - p_i|^2 + L^2 |n - n_i|^2 over the points, L = kTurnLength. Same answer as trying all of them; of
/// equals the first.
class PointTree {
 public:
  explicit PointTree(std::vector<FacingPoint> points);

  /// Index into points(); -1 where there are none.
  int nearest(const FacingPoint& p) const;
  const std::vector<FacingPoint>& points() const { return points_; }

 private:
  struct Node {
    int first = 0, last = 0;  ///< places in order_
    int axis = -1;            ///< of the six, -1 for a leaf
    double split = 0;
    int children = -1;  ///< the first of two
  };
  struct Best {
    double distance;  ///< squared
    int point;
  };

  void split(int node);
  void search(int node, const Vec6& key, Best& best) const;

  std::vector<FacingPoint> points_;
  std::vector<Vec6> keys_;  // position and L times normal
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace genu
