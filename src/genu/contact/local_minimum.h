// Local minima of the gap between two fixed surfaces: places of contact, actual or possible.
#pragma once

#include <limits>
#include <optional>
#include <span>

#include "genu/contact/contact_equations.h"

namespace genu {

struct LocalMinimum {
  ContactGeometry contact;
  double gap = 0;  ///< m, along A's normal, negative where the surfaces overlap
};

struct Descent {
  LocalMinimum minimum;
  /// The gradient vanished. False at the edge of the known surface where the gap still decreases outward.
  bool settled = false;
  Mat2 bend = Mat2::Zero();  ///< the gap's second derivatives over B's tangent plane, 1/m
};

/// Early ends of a descent; by default none.
struct DescentLimits {
  double max_step = 1e-3;  ///< m: the trust region
  /// Known minima (their points of B, frame of b). A descent whose model leads to within `same` (m) of one of them
  /// ends, and one that is in the bowl of one (in_bowl) within `bowl` (m).
  std::span<const Descent> known = {};
  double same = 0, bowl = 0;
  /// A convex model with a minimum above this gap (m) at the start ends the descent.
  double hopeless = std::numeric_limits<double>::infinity();
  /// A descent that has moved this far (m) from its start ends.
  double farthest = std::numeric_limits<double>::infinity();
};

/// What is known already of the start of a descent.
struct KnownStart {
  const SurfacePoint* on_b = nullptr;  ///< what B.project(start) gives
  const SurfacePoint* foot = nullptr;  ///< what A.project gives there, or within rounding of it
};

/// Descends from the point `start` of B (frame of b) to the nearest local minimum of the signed gap of B's points to A.
/// Newton's method with a trust region on gradient and Hessian over B's tangent plane; the gap decreases in every
/// accepted step. Empty where A is not known near a point on the way, or a limit ended the descent.
std::optional<Descent> descend_gap(const Surface& A, const Surface& B, const Pose& X_ab, const Vec3& start,
                                   const DescentLimits& limits, const KnownStart& known = {});

}  // namespace genu
