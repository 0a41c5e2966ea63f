#include "genu/mesh/vertex_triangles.h"

#include <numeric>

namespace genu {

VertexTriangles::VertexTriangles(const Mesh& mesh)
    : first_(mesh.vertices.size() + 1, 0), triangles_(3 * mesh.triangles.size()) {
  for (const auto& t : mesh.triangles)
    for (const int v : t) ++first_[at(v) + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const int v : mesh.triangles[t]) triangles_[at(next[at(v)]++)] = static_cast<int>(t);
}

}  // namespace genu
