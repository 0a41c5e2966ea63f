// Solids put together of round shapes: a function f(x) that is negative inside, with its gradient.
//
// Parts are taken in order: each is joined to what is there, cut out of it, or all that is left of it. With a blend
// length k > 0 the seam is rounded over where the two functions differ by less than k:
//   smooth min(a, b) = min(a, b) - k h^3 / 6,  h = max(0, 1 - |a - b| / k)
// which is twice continuously differentiable and at most k / 6 less than min (I. Quilez, "smooth minimum", cubic).
// Spheres, rods, tori, boxes and half spaces have their exact distance as f; ellipsoids have one that is its first
// order at the surface.
#pragma once

#include <vector>

#include "genu/core/pose.h"
#include "genu/mesh/mesh_topology.h"

namespace genu {

/// A shape in a frame of its own (S), placed in the solid's.
struct SolidPart {
  enum class Shape {
    sphere,     ///< radius, about the origin
    ellipsoid,  ///< radii along x, y, z
    rod,        ///< all spheres between two: radius at `from`, end_radius at `to`
    torus,      ///< a tube of end_radius round the circle of `radius` about z
    box,        ///< edges `radii` long in all, rounded by `radius` (>= 0)
    half_space  ///< z < 0
  };
  enum class Operation { join, cut, keep };
  Shape shape = Shape::sphere;
  Operation operation = Operation::join;
  double blend = 0;                             ///< m, >= 0
  Pose placement;                               ///< X_solid_shape
  double radius = 0, end_radius = 0;            ///< m
  Vec3 radii = Vec3::Zero();                    ///< m
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();  ///< m, of a rod, in the shape's frame
};

/// f (m) and its gradient; where that jumps, as on a ridge, one of its sides.
struct SolidValue {
  double f = 0;
  Vec3 gradient = Vec3::Zero();
};

SolidValue part_value(const SolidPart& part, const Vec3& x);

/// The smaller of two, rounded over |a.f - b.f| < k.
SolidValue smooth_min(const SolidValue& a, const SolidValue& b, double k);

class SolidField {
 public:
  /// Not empty; the first part is the start, whatever its operation.
  explicit SolidField(std::vector<SolidPart> parts) : parts_(std::move(parts)) {}

  SolidValue operator()(const Vec3& x) const;

  /// Puts x onto f = 0 along the gradient; false where it does not arrive.
  bool project(Vec3& x, Vec3& normal) const;

  /// A box that holds the solid, unless a half space was joined to it.
  BoundingBox box() const;

 private:
  std::vector<SolidPart> parts_;
};

}  // namespace genu
