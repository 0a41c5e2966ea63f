// What the local fits ask of a mesh's connectivity: who is next to whom, facing where, standing for how much area.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "genu/mesh/mesh.h"
#include "genu/mesh/stair_steps.h"

namespace genu {

struct VertexGraph {
  std::vector<Vec3> normals;   ///< outward unit normal at each vertex (area weighted); zero where no triangle is
  std::vector<double> areas;   ///< m^2, a third of the area of the triangles round each vertex
  std::vector<int> component;  ///< connected component of each vertex; -1 where no triangle is
  std::vector<int> first;      ///< vertices + 1 entries: the neighbours of v are adjacent[first[v] .. first[v + 1])
  std::vector<int> adjacent;   ///< ascending for each vertex
  /// Edges with one triangle: {from, to, triangle}, the triangle on the left.
  std::vector<std::array<int, 3>> boundary;
  std::vector<char> on_crease, near_crease;  ///< of each vertex; empty where the mesh has no creases (creases.h)
  std::vector<int> face;            ///< of each vertex, the part within creases; -1 on a crease; empty as on_crease
  std::optional<StairSteps> steps;  ///< of a segmentation that was not smoothed (creases.h)
  bool machined = false;            ///< with creases, and off them even to the rounding of its coordinates
  double median_edge = 0;           ///< m
  double area = 0;                  ///< m^2

  std::span<const int> neighbours(int v) const;
  bool is_on_crease(int v) const { return !on_crease.empty() && on_crease[static_cast<std::size_t>(v)] != 0; }
  int face_of(int v) const {
    return face.empty() ? component[static_cast<std::size_t>(v)] : face[static_cast<std::size_t>(v)];
  }
  bool is_near_crease(int v) const { return !near_crease.empty() && near_crease[static_cast<std::size_t>(v)] != 0; }
};

/// The graph of a mesh whose triangles name existing vertices.
VertexGraph vertex_graph(const Mesh& mesh);

}  // namespace genu
