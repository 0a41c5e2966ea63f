// What a contact feels of a surface that changes its shape or its place.
//
// The contact equations are geometric: how points of the surface are named while it changes does not matter. So let
// each point move along its own normal. Then w, the speed in the direction of the outward normal, and its gradient
// along the surface are all there is to know: dp = w n, dn = -T grad w, dT = n (grad w)^T. A change that moves points
// by a velocity field V(x) has w = V . n and grad w = T^T (dV/dx)^T n - S T^T V.
#pragma once

#include "genu/contact/contact_equations.h"

namespace genu {

struct SurfaceChange {
  double w = 0;                  ///< m per unit of what changes
  Vec2 gradient = Vec2::Zero();  ///< 1 per unit, in the tangent basis of the point
};

/// The change of a surface whose points move with the velocity `V` (frame of the point) and its derivative `dV` by x.
SurfaceChange change_of_field(const SurfacePoint& point, const Vec3& V, const Mat3& dV);

/// What a change of both surfaces adds to the residual of a contact and to its wrench on [a; b], bodies and surface
/// coordinates held. `force` in N.
struct ContactChange {
  Vec5 residual;
  Vec12 wrench;
};
ContactChange contact_change(const Pose& X_Wa, const Pose& X_Wb, const ContactGeometry& contact, double force,
                             const SurfaceChange& a, const SurfaceChange& b);

}  // namespace genu
