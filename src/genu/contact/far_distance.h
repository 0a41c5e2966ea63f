// Signed distance from any point to a surface. Where the surface itself cannot give it (a mesh outside the band of its
// smooth surface, a polynomial), FCL finds the nearest triangle and angle-weighted normals give the sign. At the edge
// of an open sheet, and between several sheets, the winding number gives it.
#pragma once

#include <memory>

#include "genu/surface/surface.h"

namespace genu {

class FarDistance {
 public:
  /// `edge`, `centre` and `reach` (m) bound the triangulation of closed forms without a distance function
  /// (Surface::triangles).
  explicit FarDistance(const Surface& surface, double edge = 1e-3, const Vec3& centre = Vec3::Zero(),
                       double reach = 0.1);
  struct Nearest {
    double distance = 0;            ///< m, positive outside; to the facets of a mesh: error O(h^2)
    Vec3 direction = Vec3::Zero();  ///< unit, outward: gradient of the distance
    bool beyond_edge = false;       ///< the nearest point lies on an edge of an open sheet: outside, unless x sees
                                    ///< mostly the sheet's inner side
    /// m: a point that moves less than this from x, and stays farther than `distance` from the surface, keeps its side.
    /// (A point can get behind an open sheet around its edge without coming close.) 0 for a point inside.
    double same_side = 0;
  };
  Nearest nearest(const Vec3& x) const;

 private:
  struct Triangles;  // FCL lives behind this
  const Surface* surface_;
  std::shared_ptr<const Triangles> triangles_;  // null for surfaces that know their distance; copies share it
};

}  // namespace genu
