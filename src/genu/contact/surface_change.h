// The effect on a contact of a surface that changes its shape or position.
//
// The contact equations are geometric, so the labelling of surface points during the change is irrelevant. Let each
// point move along its own normal. The normal speed w and its gradient along the surface then describe the change: dp =
// w n, dn = -T grad w, dT = n (grad w)^T. For points that move with a velocity field V(x): w = V . n and grad w = T^T
// (dV/dx)^T n - S T^T V.
#pragma once

#include "genu/contact/contact_equations.h"

namespace genu {

struct SurfaceChange {
  double w = 0;                  ///< m per unit of the parameter
  Vec2 gradient = Vec2::Zero();  ///< 1 per unit, in the tangent basis of the point
};

/// The change of a surface whose points move with velocity `V` (frame of the point) with derivative `dV` to x.
SurfaceChange change_of_field(const SurfacePoint& point, const Vec3& V, const Mat3& dV);

/// The change of a contact's residual and of its wrench on [a; b] by changes of both surfaces, at fixed poses and
/// surface coordinates. `force` in N.
struct ContactChange {
  Vec5 residual;
  Vec12 wrench;
};
ContactChange contact_change(const Pose& X_Wa, const Pose& X_Wb, const ContactGeometry& contact, double force,
                             const SurfaceChange& a, const SurfaceChange& b);

}  // namespace genu
