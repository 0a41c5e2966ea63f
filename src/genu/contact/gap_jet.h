// The signed gap of a point of one surface to another, with its derivatives, as descents ask for it.
#pragma once

#include "genu/core/pose.h"
#include "genu/surface/surface.h"

namespace genu {

/// The point of `surface` nearest to x (frame of its body), starting from the point `foot`. In contrast to
/// Surface::project it is the closest point to rounding, where the surface's curvature allows one. False when the
/// search leaves the surface.
bool closest_point(const Surface& surface, const Vec3& x, SurfacePoint& foot);

/// A point of B, its foot on A, and the gap between them with its first two derivatives over B's tangent plane.
struct GapJet {
  SurfacePoint a, b;
  double value = 0;  ///< m
  Vec2 gradient = Vec2::Zero();
  Mat2 hessian = Mat2::Zero();  ///< 1/m

  bool is_convex() const { return hessian.determinant() > 0 && hessian.trace() > 0; }
  Mat2 bend() const { return 0.5 * (hessian + hessian.transpose()); }
};

/// Completes a jet whose point `b` is set, to rounding, beginning at the foot `near` (A's frame) where there is one.
bool evaluate_gap(const Surface& A, const Pose& X_ab, const SurfacePoint* near, GapJet& jet);

/// The same with a foot that may be off by `enough` (m) and by what A.retract_roughly() errs.
bool evaluate_gap_roughly(const Surface& A, const Pose& X_ab, const SurfacePoint* near, double enough, GapJet& jet);

}  // namespace genu
