// The local minimum of the gap between two surfaces held still: where a contact is, or would be.
#pragma once

#include <optional>

#include "genu/contact/contact_equations.h"

namespace genu {

struct LocalMinimum {
  ContactGeometry contact;
  double gap = 0;  ///< m, along A's normal, negative where the surfaces overlap
};

/// The point of `surface` nearest to x (frame of its body), starting from the point `foot`: unlike Surface::project this
/// is the true closest point to rounding, where the surface's curvature allows one. Returns false when the search leaves
/// the surface.
bool closest_point(const Surface& surface, const Vec3& x, SurfacePoint& foot);

/// Descends from the point `start` of B (frame of b) to the nearest local minimum of the signed gap of B's points to A:
/// Newton on the gap's gradient and Hessian over B's tangent plane, in a trust region of at most `max_step` (m), so that
/// the gap falls with every accepted step. Empty where A is not known near a point on the way. `settled` says whether
/// the gradient vanished: false at the edge of what is known, where the gap still falls outward.
struct Descent {
  LocalMinimum minimum;
  bool settled = false;
};
std::optional<Descent> descend_gap(const Surface& A, const Surface& B, const Pose& X_ab, const Vec3& start,
                                   double max_step);

}  // namespace genu
