// Points of the reference knee as a mesh.
#pragma once

#include <array>
#include <vector>

#include "genu/atlas/registration.h"
#include "genu/mesh/mesh.h"

namespace genu::test {

/// Triangles between neighbours of a reference bone would be a mesh; its own points as tiny triangles do as well.
inline Mesh as_mesh(const std::vector<FacingPoint>& points, const Affine& map) {
  Mesh mesh;
  for (const FacingPoint& p : points) {
    const Vec3 aside = p.normal.unitOrthogonal() * 1e-5, up = p.normal.cross(aside);
    const bool reflects = map.linear.determinant() < 0;
    const int first = static_cast<int>(mesh.vertices.size());
    for (const Vec3& corner : {Vec3(p.at - aside), Vec3(p.at + aside), Vec3(p.at + up)})
      mesh.vertices.push_back(map(corner));
    mesh.triangles.push_back(reflects ? std::array{first, first + 2, first + 1}
                                      : std::array{first, first + 1, first + 2});
  }
  return mesh;
}

}  // namespace genu::test
