// How the triangles of a mesh hang together: edges, sheets, boundaries, neighbours, orientation.
#pragma once

#include <array>
#include <vector>

#include "genu/mesh/mesh.h"

namespace genu {

/// An undirected edge v[0] < v[1] and the triangles beside it: t[0] < t[1], t[1] = -1 on a boundary. Where more than
/// two triangles meet, the edge is listed with the first two and `count` tells how many there are.
struct MeshEdge {
  std::array<int, 2> v{};
  std::array<int, 2> t{-1, -1};
  int count = 0;
};

/// All edges, sorted by v[0], then v[1].
std::vector<MeshEdge> mesh_edges(const Mesh& mesh);

/// For every vertex the vertices it shares an edge with, ascending: those of v are
/// neighbours[offset[v]] .. neighbours[offset[v + 1] - 1].
struct VertexNeighbours {
  std::vector<int> offset;      ///< vertices + 1
  std::vector<int> neighbours;  ///< 2 x edges
};
VertexNeighbours vertex_neighbours(const Mesh& mesh, const std::vector<MeshEdge>& edges);

/// For every vertex: does it lie on an edge with one triangle only?
std::vector<bool> boundary_vertices(const Mesh& mesh, const std::vector<MeshEdge>& edges);

/// Closed loops of boundary edges, each starting at its smallest vertex and walked with the surface on the left (seen
/// from outside), ordered by that vertex. At a vertex where several loops touch they are parted arbitrarily but
/// always the same way.
std::vector<std::vector<int>> boundary_loops(const Mesh& mesh, const std::vector<MeshEdge>& edges);

/// Triangles connected through edges (not through single vertices) form a component.
struct Components {
  std::vector<int> of_triangle;  ///< component of each triangle, numbered by first triangle
  int count = 0;
};
Components connected_components(const Mesh& mesh);

/// What make_winding_consistent found.
struct WindingReport {
  std::size_t flipped = 0;  ///< triangles turned round
  bool orientable = true;   ///< false where no winding agrees everywhere (a Moebius strip)
};

/// Turns triangles round until neighbours agree; of the two windings a component can have, the one with fewer
/// triangles turned. Which side is outward is thus the file's word: the signed volume of an open sheet says nothing
/// about it. Edges with more than two triangles are not crossed.
WindingReport make_winding_consistent(Mesh& mesh, const std::vector<MeshEdge>& edges);

/// Unit normals at the vertices: the mean of the triangles' normals weighted by their angle at the vertex (Thuermer
/// and Wuethrich 1998), which does not depend on how the surface is cut into triangles. Zero for an unused vertex.
std::vector<Vec3> vertex_normals(const Mesh& mesh);

/// The median length of the edges (m); 0 without edges.
double median_edge_length(const Mesh& mesh, const std::vector<MeshEdge>& edges);

struct BoundingBox {
  Vec3 low = Vec3::Zero();
  Vec3 high = Vec3::Zero();
  double diagonal() const { return (high - low).norm(); }
};

/// The axis-parallel box of all vertices (m); all zero for a mesh without vertices.
BoundingBox bounding_box(const Mesh& mesh);

}  // namespace genu
