// The corners of solids, as of a sheet with walls round it: what tells them from a vertex that stands out by error.
#pragma once

#include <vector>

#include "genu/mesh/mesh.h"
#include "genu/mesh/mesh_topology.h"

namespace genu {

/// Creases are edges where the mesh bends by more than 40 deg. At a corner at least three of them meet that go on
/// beyond its neighbours; those of a spike end in the ring round it.
class SharpCorners {
 public:
  SharpCorners(const Mesh& mesh, const std::vector<MeshEdge>& edges);
  bool is_corner(int vertex) const;

 private:
  bool goes_on(int from, int to) const;
  std::vector<std::vector<int>> neighbours_, creases_;  ///< of each vertex: the other ends of its edges
};

}  // namespace genu
