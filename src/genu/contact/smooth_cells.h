// A surface divided into triangular cells, each with a lattice of nodes on the smooth surface.
//
// The cells are the triangles of a mesh of the surface. With n divisions along each edge, neighbours share the nodes on
// their edges. The nodes of n / 2 are among those of n.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "genu/surface/surface.h"

namespace genu {

class SmoothCells {
 public:
  /// A node's place, m, and the outward unit normal there.
  struct Node {
    Vec3 x = Vec3::Zero();
    Vec3 n = Vec3::UnitZ();
    bool ridge = false;  ///< on a sharp edge, or between one and a face: `n` is no face's normal
  };
  /// A place in the lattice of a cell: i of `divisions` along the edge from its first corner to the second, j along the
  /// edge to the third.
  struct Place {
    int cell = 0;
    int divisions = 1;
    int i = 0, j = 0;
  };

  static bool is_corner(const Place& p) { return p.i == p.divisions || p.j == p.divisions || (p.i == 0 && p.j == 0); }
  static Place corner(const Place& p, int k) {
    return {p.cell, p.divisions, k == 1 ? p.divisions : 0, k == 2 ? p.divisions : 0};
  }
  /// Weights of the cell's corners at the node; exact where `divisions` is a power of two.
  static std::array<double, 3> shares(const Place& p) {
    const double n = p.divisions;
    return {1 - (p.i + p.j) / n, p.i / n, p.j / n};
  }

  SmoothCells(Mesh mesh, std::shared_ptr<const Surface> surface);

  int cell_count() const { return static_cast<int>(mesh_.triangles.size()); }
  int node_count(int divisions) const;
  /// The same number from every cell that shares the node.
  int number(const Place& place) const;
  /// Projects a node of the flat cell onto the surface. It stays on the flat cell, with an interpolated normal, where
  /// the surface is not known there or is too far from the cell's corners and normals. `length`: of the line along the
  /// normal that belongs to the node, m.
  Node node(const Place& place, double length) const;

  /// m: upper bound of the distance from `middle` of any node of the cell and of any point `length` along its normal to
  /// either side (from the same point of `middle`).
  double radius(int cell, const Node& middle, double length) const;
  Node middle(int cell) const;
  /// The place of its corner k, m.
  const Vec3& corner(int cell, int k) const;
  /// The cell beyond the side from corner `side` to the next; -1: none, or more than one.
  int neighbour(int cell, int side) const;
  /// The same number from every cell that shares the edge.
  int edge(int cell, int side) const;
  int edge_count() const { return edge_count_; }
  double longest_edge(int cell) const { return longest_edges_[static_cast<std::size_t>(cell)]; }
  /// Mean of the cells' longest edges, m.
  double mean_edge() const { return mean_; }

  const Surface& surface() const { return *surface_; }
  /// Of its vertices, on the surface.
  const std::vector<Node>& corners() const { return corners_; }
  const std::array<int, 3>& vertices(int cell) const { return mesh_.triangles[static_cast<std::size_t>(cell)]; }

 private:
  std::array<const Node*, 3> corners(int cell) const;
  void find_edges();
  void place_corners();

  Mesh mesh_;
  std::shared_ptr<const Surface> surface_;
  std::vector<Node> corners_;                   // of the mesh's vertices
  std::vector<std::array<int, 3>> edges_;       // of each cell: from corner 0 to 1, 1 to 2, 2 to 0
  std::vector<double> longest_edges_;           // m, of each cell
  std::vector<std::array<int, 3>> neighbours_;  // of each cell, by side
  int edge_count_ = 0;
  double mean_ = 0;  // m: of the longest edges
};

}  // namespace genu
