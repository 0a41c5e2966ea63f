// Inertia terms of a moving body in the equations of motion.
//
// With the twist [v, w] of a pose's origin O, the centre of mass at c from O (world axes) and I the inertia about it,
// the momentum is m (v + w x c), and Newton's and Euler's laws about O are  M [a, alpha] + b = wrench  with
//   M = [ m, -m [c]x; m [c]x, I - m [c]x [c]x ],  b = [ m w x (w x c); w x I w + c x m (w x (w x c)) ].
#pragma once

#include "genu/core/types.h"

namespace genu {

struct Inertia {
  double mass = 0;                           ///< kg
  Vec3 centre_of_mass = Vec3::Zero();        ///< m, in the body
  Mat3 about_centre_of_mass = Mat3::Zero();  ///< kg m^2, in the body's axes; products as matrix elements
};

/// M for the orientation R of the body in the world: kg, kg m, kg m^2.
Mat6 mass_matrix(const Inertia& inertia, const Mat3& R);

/// b, the gyroscopic and centrifugal terms: [N, N m] about the origin, for the angular velocity w (rad/s, world axes).
Vec6 gyroscopic_wrench(const Inertia& inertia, const Mat3& R, const Vec3& w);

/// J
double kinetic_energy(const Inertia& inertia, const Mat3& R, const Vec6& twist);

}  // namespace genu
