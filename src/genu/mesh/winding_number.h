// How often a mesh winds round a point: which side of it the point is on, whatever holes the mesh has.
//
// The solid angle under which the triangles are seen from x, by 4 pi: 1 inside a closed mesh, 0 outside it, and in
// between where part of the mesh is missing (Jacobson, Kavan and Sorkine-Hornung 2013). Groups of triangles far away
// count as one dipole (Barill, Dickson, Schmidt, Levin and Jacobson 2018).
#pragma once

#include <vector>

#include "genu/mesh/mesh.h"

namespace genu {

class WindingNumber {
 public:
  WindingNumber() = default;
  explicit WindingNumber(const Mesh& mesh);

  /// At x (m). The dipoles err by less than 0.04 (test WindingNumber.FastIsExact).
  double operator()(const Vec3& x) const;

  /// Most of what is seen from x is the inner side.
  bool inside(const Vec3& x) const { return (*this)(x) > 0.5; }

 private:
  struct Node {
    Vec3 centre = Vec3::Zero();  ///< area weighted, m
    Vec3 area = Vec3::Zero();    ///< sum of the triangles' area vectors, m^2
    double radius = 0;           ///< m, round the centre: holds all triangles
    int first = 0, last = 0;     ///< triangles
    int children = -1;           ///< index of the first of two; -1 for a leaf
  };

  struct Pieces;  // what is known of each triangle while the tree is made
  void split(Pieces& pieces, int first, int last);

  std::vector<std::array<Vec3, 3>> triangles_;
  std::vector<Node> nodes_;  // the root first
};

}  // namespace genu
