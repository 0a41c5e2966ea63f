// A segment as the tree of triangles asks it: against boxes, and against triangles.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "genu/core/types.h"
#include "genu/mesh/tolerances.h"

namespace genu {

/// The part of a segment inside a box grown by `margin`: its entry, or infinity where there is none.
struct Slab {
  static constexpr double kOutside = std::numeric_limits<double>::infinity();

  Slab(const Vec3& o, const Vec3& d, double l) : origin(o), length(l) {
    // Along an axis that the segment does not move in, it is inside for ever or never: a very large slope says the same
    // without a case of its own.
    for (Eigen::Index i = 0; i < 3; ++i) inverse[i] = 1 / (std::abs(d[i]) < kMinRayComponent ? kMinRayComponent : d[i]);
  }

  double entry(const Vec3& low, const Vec3& high, double margin, double most) const {
    double in = 0, out = most;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const double a = (low[i] - margin - origin[i]) * inverse[i], b = (high[i] + margin - origin[i]) * inverse[i];
      in = std::max(in, std::min(a, b));
      out = std::min(out, std::max(a, b));
    }
    return in <= out ? in : kOutside;
  }

  Vec3 origin, inverse;
  double length;
};

/// A ray with what its triangles are asked for: points are sheared along it into a plane across it, each alike for all
/// triangles that share it, so that no ray passes between them (Woop, Benthin and Wald 2013).
struct RayLine {
  RayLine(const Vec3& o, const Vec3& d, double l) : origin(o), direction(d), length(l) {
    d.cwiseAbs().maxCoeff(&z);
    x = (z + 1) % 3;
    y = (z + 2) % 3;
    slope = Vec2(d[x], d[y]) / d[z];
  }

  Vec2 across(const Vec3& p) const {
    const double along = p[z] - origin[z];
    return {p[x] - origin[x] - slope[0] * along, p[y] - origin[y] - slope[1] * along};
  }

  Vec3 origin, direction;
  double length;
  Eigen::Index x = 0, y = 0, z = 0;
  Vec2 slope;
};

}  // namespace genu
