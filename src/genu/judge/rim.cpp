#include "genu/judge/rim.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "genu/judge/tolerances.h"

namespace genu::judge {
namespace {

using Point = std::complex<double>;  // across the ray, in units of the disc's radius

double dot(Point p, Point q) { return p.real() * q.real() + p.imag() * q.imag(); }

/// The part of the disc, of area pi, between the chord of an edge and the circle as the centre sees them: negative if
/// the centre lies on the right of the edge.
double behind(Point a, Point b) {
  const Point way = (b - a) / std::abs(b - a);
  const double start = dot(way, a), end = dot(way, b), off2 = std::norm(a) - start * start;
  if (off2 >= 1) return 0;
  const double half = std::sqrt(1 - off2);
  const double from = std::clamp(start, -half, half), to = std::clamp(end, -half, half);
  if (from == to) return 0;
  const Point c = a + (from - start) * way, d = a + (to - start) * way, turn = d * std::conj(c);
  return (std::arg(turn) - turn.imag()) / 2;
}

}  // namespace

Rim::Part Rim::part(const Disc& disc, const std::optional<double>& met) const {
  const Vec3 one = disc.direction.unitOrthogonal(), two = disc.direction.cross(one);
  Part out{met ? 1.0 : 0.0, met.value_or(0)};
  double weights = 0, depths = 0, nearest = 1;
  for (const Edge& edge : edges_) {
    const Vec3 u = edge.a - disc.origin, v = edge.b - disc.origin;
    const double long_way = (v - u).norm() + disc.radius;
    if (u.squaredNorm() - std::pow(u.dot(disc.direction), 2) > long_way * long_way) continue;
    if (edge.normal.dot(disc.direction) <= 0) continue;
    const Point a = Point(one.dot(u), two.dot(u)) / disc.radius, b = Point(one.dot(v), two.dot(v)) / disc.radius;
    if (a == b) continue;
    const double at = std::clamp(dot(-a, b - a) / std::norm(b - a), 0.0, 1.0), off = std::abs(a + at * (b - a));
    const double depth = disc.direction.dot(u + at * (v - u));
    if (off >= 1 || depth > disc.reach || depth < -kBorderDepth * disc.radius) continue;
    if (met && std::abs(depth - *met) > kBorderDepth * disc.radius) continue;
    out.share -= behind(a, b) / M_PI;
    const double weight = std::pow(1 / std::max(off * off, kThroughBorder * kThroughBorder) - 1, 2);
    weights += weight;
    depths += weight * depth;
    nearest = std::min(nearest, off);
  }
  if (nearest < kThroughBorder) out.share -= std::floor(out.share);
  out.share = std::clamp(out.share, 0.0, 1.0);
  if (!met && weights > 0) out.depth = depths / weights;
  return out;
}

}  // namespace genu::judge
