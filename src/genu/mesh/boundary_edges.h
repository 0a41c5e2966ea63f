// How far a point of an open mesh is from the mesh's edge.
#pragma once

#include "genu/mesh/cell_lists.h"
#include "genu/mesh/mesh.h"
#include "genu/mesh/vertex_graph.h"

namespace genu {

class BoundaryEdges {
 public:
  BoundaryEdges() = default;
  BoundaryEdges(const Mesh& mesh, const VertexGraph& graph, double cap);

  bool empty() const { return edges_.empty(); }

  /// Distance (m) in the tangent plane from p, near the mesh, to the nearest boundary edge of `component`: positive
  /// inside, negative where p lies past the edge, `cap` where no edge is nearer than that.
  double signed_distance(const Vec3& p, int component) const;

  template <typename Archive>
  void serialize(Archive& a) {
    a(cap_, edges_, cells_);
  }

 private:
  struct Edge {
    Vec3 a, b;                  ///< m, the surface on the left
    Vec3 normal;                ///< of the facet
    Vec3 outward;               ///< unit, in the facet's plane, away from the surface
    Vec3 outward_a, outward_b;  ///< at the ends: the mean of the two edges that meet there
    int component = 0;

    template <typename Archive>
    void serialize(Archive& archive) {
      archive(a, b, normal, outward, outward_a, outward_b, component);
    }
  };

  double cap_ = 0;
  std::vector<Edge> edges_;
  CellLists cells_;
};

}  // namespace genu
