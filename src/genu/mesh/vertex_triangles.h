// The triangles round each vertex of a mesh.
#pragma once

#include <span>
#include <vector>

#include "genu/mesh/mesh.h"

namespace genu {

class VertexTriangles {
 public:
  /// Of a mesh whose triangles name existing vertices.
  explicit VertexTriangles(const Mesh& mesh);

  /// Those of vertex v, ascending; one that names v twice is there twice.
  std::span<const int> of(int v) const {
    return std::span(triangles_).subspan(at(first_[at(v)]), at(first_[at(v) + 1] - first_[at(v)]));
  }

 private:
  std::vector<int> first_, triangles_;  // those of v from first_[v] on
};

}  // namespace genu
