// A geodesic of a surface from a point along a direction, with its natural variations.
//
// With the normal n, the unit tangent t, b = n x t and the shape operator S in (t, b),
//
//   S = [kappa tau; tau mu],   x' = t,   t' = kappa n,   n' = -kappa t - tau b,   b' = tau n.
//
// Neighbours part by Jacobi fields y'' + K y = 0 (K: Gaussian curvature) along b: c from (1, 0), a from (0, 1). They
// are integrated with the geodesic; on spheres and cylinders all is in closed form.
#pragma once

#include <cmath>

#include "genu/surface/surface.h"
#include "genu/wrap/tolerances.h"

namespace genu {

/// One end of an arc, in the frame of the surface's body.
struct ArcEnd {
  Vec3 p = Vec3::Zero();   ///< m
  Vec3 t = Vec3::UnitX();  ///< unit tangent, along the string
  Vec3 n = Vec3::UnitZ();  ///< outward unit normal
  double kappa = 0;        ///< 1/m, negative where the string presses on the surface
  double tau = 0;          ///< 1/m
  double mu = 0;           ///< 1/m

  Vec3 b() const { return n.cross(t); }
};

struct Geodesic {
  ArcEnd begin, end;
  double length = 0;     ///< m; negative: run backwards, the continuation of a string that is about to leave
  double c = 1, dc = 0;  ///< Jacobi field from (1, 0) at the end, and its derivative (1/m)
  double a = 0, da = 1;  ///< m, and the one from (0, 1)
  /// Largest kappa on the way, 1/m: where it is positive the string would lift off.
  double most_hollow = 0;
  double hollow_at = 0;      ///< m along the arc: where that is
  double hollow_length = 0;  ///< m: of the way where kappa is positive, about

  /// m: how much shorter a string may be that lifts off where the surface is hollow (a chord for an arc).
  double lift() const { return most_hollow > 0 ? most_hollow * most_hollow * std::pow(hollow_length, 3) / 24 : 0; }
  bool conjugate = false;  ///< a returns to 0 on the way: the arc is no shortest one
};

/// An end on the surface at p, along the tangential part of t. False where there is no surface or no such direction.
[[nodiscard]] bool arc_end(const Surface& surface, const Vec3& p, const Vec3& t, ArcEnd& out);

/// The geodesic of that length (m) from `begin`. False where it runs off the surface. `error`: lengths over the radius
/// of curvature and angles in rad, larger for one that is not the last; not of surfaces that are smooth piece by piece.
[[nodiscard]] bool shoot(const Surface& surface, const ArcEnd& begin, double length, Geodesic& out,
                         double error = kGeodesicError);

/// Calls f(point) for points of the geodesic at most `spacing` (m) apart, both ends included, in the body's frame.
template <typename F>
void for_points(const Surface& surface, const Geodesic& arc, double spacing, const F& f) {
  const int steps = arc.length > 0 ? 1 + static_cast<int>(arc.length / spacing) : 0;
  f(arc.begin.p);
  Geodesic part;
  ArcEnd from = arc.begin;
  for (int k = 1; k < steps; ++k) {
    if (!shoot(surface, from, arc.length / steps, part)) break;
    from = part.end;
    f(from.p);
  }
  if (steps > 0) f(arc.end.p);
}

}  // namespace genu
