#include "genu/mesh/nearest_point.h"

#include <limits>

#include "genu/mesh/mesh_topology.h"

namespace genu {

Vec3 nearest_on_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = x - a, bp = x - b, cp = x - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return a;
  if (d3 >= 0 && d4 <= d3) return b;
  if (d6 >= 0 && d5 <= d6) return c;
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b);
  const double sum = va + vb + vc;
  if (!(sum > 0)) return a;  // without area
  return a + vb / sum * ab + vc / sum * ac;
}

Vec3 nearest_on_mesh(const Mesh& mesh, const Vec3& x, std::size_t* triangle) {
  Vec3 nearest = x;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const auto& t = mesh.triangles[k];
    const Vec3 p = nearest_on_triangle(x, mesh.vertices[at(t[0])], mesh.vertices[at(t[1])], mesh.vertices[at(t[2])]);
    const double d = (p - x).squaredNorm();
    if (d < least) {
      least = d;
      nearest = p;
      if (triangle != nullptr) *triangle = k;
    }
  }
  return nearest;
}

}  // namespace genu
