#include "genu/wrap/arc_change.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "genu/wrap/tolerances.h"

namespace genu {
namespace {

/// Gauss and Legendre's rule of five points on (0, 1).
struct Node {
  double place, weight;
};
constexpr std::array<Node, 5> kNodes = {{{0.046910077030668, 0.118463442528095},
                                         {0.230765344947158, 0.239314335249683},
                                         {0.5, 0.284444444444444},
                                         {0.769234655052842, 0.239314335249683},
                                         {0.953089922969332, 0.118463442528095}}};

/// The longest part of an arc that one rule integrates.
double longest_part(const Surface& surface, const ArcEnd& at) {
  const double bend = std::max({std::abs(at.kappa), std::abs(at.mu), std::abs(at.tau), 1e-300});
  const double turned = kChangeTurn / bend, smooth = surface.smooth_length();
  return std::isfinite(smooth) ? std::min(turned, kGeodesicStep * smooth) : turned;
}

/// What the surface does to an arc at one of its points.
struct Local {
  double v = 0, along = 0, across = 0;  ///< v, and its gradient along t and b
};

bool local(const Surface& surface, const ArcEnd& at, const std::function<NormalSpeed(const SurfacePoint&)>& speed,
           Local& out) {
  SurfacePoint point;
  if (!surface.project(at.p, point)) return false;
  const NormalSpeed here = speed(point);
  const Vec3 gradient = point.T * here.gradient;
  out = {here.v, gradient.dot(at.t), gradient.dot(at.b())};
  return true;
}

}  // namespace

bool arc_change(const Surface& surface, const Geodesic& arc,
                const std::function<NormalSpeed(const SurfacePoint&)>& speed, ArcChange& out) {
  out = {};
  Local here;
  if (!local(surface, arc.begin, speed, here)) return false;
  out.begin = here.v * arc.begin.n;
  Mat2 Phi = Mat2::Identity();
  Vec2 sum = Vec2::Zero();
  ArcEnd place = arc.begin;
  Geodesic part;
  // Follows the geodesic by ds, with its Jacobi fields from the begin.
  const auto go = [&](double ds) {
    if (!shoot(surface, place, ds, part)) return false;
    place = part.end;
    Mat2 next;
    next << part.c, part.a, part.dc, part.da;
    Phi = next * Phi;
    return true;
  };
  for (double done = 0; done < arc.length;) {
    const double rest = arc.length - done;
    const double h = rest / std::ceil(rest / longest_part(surface, place));
    double reached = 0;
    for (const Node& node : kNodes) {
      if (!go(node.place * h - reached) || !local(surface, place, speed, here)) return false;
      reached = node.place * h;
      const Vec2 source(place.tau * here.v, place.tau * here.along - place.kappa * here.across);
      sum += node.weight * h *
             Vec2(Phi(1, 1) * source[0] - Phi(0, 1) * source[1], Phi(0, 0) * source[1] - Phi(1, 0) * source[0]);
      out.length -= node.weight * h * place.kappa * here.v;
    }
    if (!go(h - reached)) return false;
    done = h < rest ? done + h : arc.length;
  }
  const Vec2 moved = Phi * sum;
  if (!local(surface, arc.end, speed, here)) return false;
  out.end = here.v * arc.end.n + moved[0] * arc.end.b();
  out.turn = moved[1];
  return true;
}

}  // namespace genu
