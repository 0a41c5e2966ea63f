// What the local fits ask of a mesh's connectivity: who is next to whom, facing where, standing for how much area.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "genu/mesh/mesh.h"

namespace genu {

struct VertexGraph {
  std::vector<Vec3> normals;   ///< outward unit normal at each vertex (area weighted); zero where no triangle is
  std::vector<double> areas;   ///< m^2, a third of the area of the triangles round each vertex
  std::vector<int> component;  ///< connected component of each vertex; -1 where no triangle is
  std::vector<int> first;      ///< vertices + 1 entries: the neighbours of v are adjacent[first[v] .. first[v + 1])
  std::vector<int> adjacent;   ///< ascending for each vertex
  /// Edges with one triangle: {from, to, triangle}, the triangle on the left.
  std::vector<std::array<int, 3>> boundary;
  double median_edge = 0;  ///< m
  double area = 0;         ///< m^2

  std::span<const int> neighbours(int v) const;
};

/// The graph of a mesh whose triangles name existing vertices.
VertexGraph vertex_graph(const Mesh& mesh);

}  // namespace genu
