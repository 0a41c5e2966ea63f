// Signed distance of a point to a surface wherever the point is: outside the band of a meshed surface FCL finds the
// closest triangle, and the surface's own angle-weighted normals tell the side.
#pragma once

#include <memory>

#include "genu/geometry/surface.h"

namespace genu {

class FarDistance {
 public:
  explicit FarDistance(const Surface& surface);
  ~FarDistance();
  FarDistance(FarDistance&&) noexcept;
  FarDistance& operator=(FarDistance&&) noexcept;

  struct Nearest {
    double distance = 0;          ///< m, positive outside; of facets where the surface is a mesh: error O(h^2)
    Vec3 direction = Vec3::Zero(); ///< unit, outward: where the distance grows
    bool beyond_edge = false;     ///< the nearest point lies on an edge of an open sheet: no side, distance unsigned
  };
  Nearest nearest(const Vec3& x) const;

 private:
  struct Triangles;  // FCL lives behind this
  const Surface* surface_;
  std::unique_ptr<Triangles> triangles_;  // null for surfaces known everywhere
};

}  // namespace genu
