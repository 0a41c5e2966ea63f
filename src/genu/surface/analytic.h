// Surfaces with a formula. Each lives in a frame of its own (S), is put into its body (B) by X_BS, and may be turned
// inside out (`inside`: the outward side is the hollow one, a socket). The shapes and their outward sides:
//   plane        z = 0, outward +z
//   sphere       |p| = radius
//   ellipsoid    (x/a)^2 + (y/b)^2 + (z/c)^2 = 1
//   cylinder     x^2 + y^2 = radius^2, without ends
//   torus        a tube of minor_radius round the circle x^2 + y^2 = major_radius^2, z = 0
//   polynomial   z = sum c x^i y^j, outward +z
//   cylindrical  r = sum c theta^i z^j, outward away from the axis; theta (rad) from x toward y, in (-pi, pi]: where
//                the polynomial does not close round the axis, the surface ends at theta = pi
// project() gives the closest point: in closed form for plane, sphere, cylinder and torus, over the whole surface for
// the ellipsoid, and the closest point reached by descent from the one above x for polynomials. It returns false where
// that point is not unique: the centre of a sphere, the axis of a cylinder or torus, the circle inside a torus' tube.
// gap() is the signed distance to that point.
//
// Every factory returns null where its arguments make no surface: a length that is not positive and finite, a torus
// without a hole (minor_radius >= major_radius), a polynomial without terms or with an exponent outside
// 0..kMaxPolynomialExponent. The checker of scenes refuses these with a better message.
#pragma once

#include <memory>
#include <vector>

#include "genu/core/pose.h"
#include "genu/surface/surface.h"

namespace genu {

/// c x^i y^j (or c theta^i z^j), SI
struct PolynomialTerm {
  int i = 0;
  int j = 0;
  double c = 0;
};

inline constexpr int kMaxPolynomialExponent = 30;

std::unique_ptr<Surface> make_plane(const Pose& X_BS, bool inside);
std::unique_ptr<Surface> make_sphere(const Pose& X_BS, double radius, bool inside);
std::unique_ptr<Surface> make_ellipsoid(const Pose& X_BS, const Vec3& radii, bool inside);
std::unique_ptr<Surface> make_cylinder(const Pose& X_BS, double radius, bool inside);
std::unique_ptr<Surface> make_torus(const Pose& X_BS, double major_radius, double minor_radius, bool inside);
std::unique_ptr<Surface> make_polynomial(const Pose& X_BS, const std::vector<PolynomialTerm>& terms, bool inside);
std::unique_ptr<Surface> make_cylindrical_polynomial(const Pose& X_BS, const std::vector<PolynomialTerm>& terms,
                                                     bool inside);

}  // namespace genu
