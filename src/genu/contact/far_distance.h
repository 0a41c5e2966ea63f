// Signed distance of a point to a surface wherever the point is. Where the surface does not know it (a mesh outside the
// band of its smooth surface, a polynomial), FCL finds the closest triangle and angle-weighted normals tell the side;
// at the edge of an open sheet, and between several sheets, the winding number does.
#pragma once

#include <memory>

#include "genu/surface/surface.h"

namespace genu {

class FarDistance {
 public:
  /// `edge`, `centre` and `reach` (m) bound the triangles of closed forms that do not know their distance
  /// (Surface::triangles).
  explicit FarDistance(const Surface& surface, double edge = 1e-3, const Vec3& centre = Vec3::Zero(),
                       double reach = 0.1);
  struct Nearest {
    double distance = 0;            ///< m, positive outside; of facets where the surface is a mesh: error O(h^2)
    Vec3 direction = Vec3::Zero();  ///< unit, outward: where the distance grows
    bool beyond_edge = false;       ///< the nearest point lies on an edge of an open sheet: outside, unless most of
                                    ///< what is seen from x is the sheet's inner side
    /// m: within so far of x a point that is outside, as x is, stays so, unless it comes nearer than `distance` to the
    /// surface. Round the edge of an open sheet a point gets behind it without coming near it. 0 for a point inside.
    double same_side = 0;
  };
  Nearest nearest(const Vec3& x) const;

 private:
  struct Triangles;  // FCL lives behind this
  const Surface* surface_;
  std::shared_ptr<const Triangles> triangles_;  // null for surfaces that know their distance; copies share it
};

}  // namespace genu
