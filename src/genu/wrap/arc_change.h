// How an arc of a string changes, to first order, when its surface changes shape: v is the normal speed of the surface.
//
// On the geodesic x(s) with the frame (t, b, n) of geodesic.h let each point move by v n + y b. The curve remains a
// geodesic if, with w the turn of its tangent toward b,
//
//   y' = w + tau v        w' = -K y + tau v' - kappa (grad v . b)        v' = grad v . t
//
// and its length changes by -integral of kappa v. The solution from (y, w) = (0, 0) follows from the Jacobi fields c,
// a: with the matrix Phi = [c a; c' a'] it is Phi(end) times the integral of Phi^-1 (tau v, tau v' - kappa grad v . b).
#pragma once

#include <functional>

#include "genu/wrap/geodesic.h"

namespace genu {

/// Per unit of a parameter, in the frame of the surface's body or, turned, of the world.
struct ArcChange {
  Vec3 begin = Vec3::Zero(), end = Vec3::Zero();  ///< m: of the ends
  double length = 0;                              ///< m
  double turn = 0;                                ///< rad: of the tangent at the end, toward b
};

/// The normal speed of a surface at one of its points, and its gradient along the surface in the point's tangent basis.
struct NormalSpeed {
  double v = 0;
  Vec2 gradient = Vec2::Zero();
};

/// The change of an arc that begins at the same place and along the same direction, but for the surface's own motion.
/// False where the surface is left.
[[nodiscard]] bool arc_change(const Surface& surface, const Geodesic& arc,
                              const std::function<NormalSpeed(const SurfacePoint&)>& speed, ArcChange& out);

}  // namespace genu
