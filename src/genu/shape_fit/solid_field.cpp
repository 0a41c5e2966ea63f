#include "genu/shape_fit/solid_field.h"

#include <algorithm>
#include <cmath>

#include "genu/shape_fit/tolerances.h"

namespace genu {
namespace {

using Shape = SolidPart::Shape;
using Operation = SolidPart::Operation;

SolidValue ball(const Vec3& p, double radius) {
  const double r = p.norm();
  return {r - radius, r > 0 ? Vec3(p / r) : Vec3::Zero()};
}

/// k0 (k0 - 1) / k1 with k0 = |p / r|, k1 = |p / r^2|: the distance to first order.
SolidValue ellipsoid(const Vec3& p, const Vec3& radii) {
  const Vec3 q = p.cwiseQuotient(radii), g = q.cwiseQuotient(radii);
  const double k0 = q.norm(), k1 = g.norm();
  if (!(k1 > 0)) return {-radii.minCoeff(), Vec3::Zero()};
  const double f = k0 * (k0 - 1) / k1;
  const Vec3 of_k1 = g.cwiseQuotient(radii.cwiseProduct(radii)) / k1;
  return {f, (2 * k0 - 1) / (k0 * k1) * g - f / k1 * of_k1};
}

/// The hull of two balls.
SolidValue rod(const Vec3& p, const SolidPart& part) {
  const Vec3 along = part.to - part.from;
  const double length = along.norm(), slope = (part.radius - part.end_radius) / length;
  // One ball holds the other.
  if (!(std::abs(slope) < 1))
    return part.radius > part.end_radius ? ball(p - part.from, part.radius) : ball(p - part.to, part.end_radius);
  const Vec3 axis = along / length, q = p - part.from;
  const double z = q.dot(axis);
  const Vec3 across = q - z * axis;
  const double r = across.norm(), cosine = std::sqrt(1 - slope * slope);
  // Where the normal of the cone through q meets the axis.
  const double foot = z - r * slope / cosine;
  if (foot <= 0) return ball(q, part.radius);
  if (foot >= length) return ball(p - part.to, part.end_radius);
  const Vec3 radial = r > 0 ? Vec3(across / r) : Vec3(axis.unitOrthogonal());
  return {r * cosine + z * slope - part.radius, cosine * radial + slope * axis};
}

SolidValue torus(const Vec3& p, double major, double minor) {
  const double r = std::hypot(p.x(), p.y());
  const Vec3 radial = r > 0 ? Vec3(p.x() / r, p.y() / r, 0) : Vec3::Zero();
  const Vec3 from_circle = (r - major) * radial + p.z() * Vec3::UnitZ();
  return ball(from_circle, minor);
}

SolidValue box(const Vec3& p, const Vec3& size, double rounding) {
  const Vec3 q = p.cwiseAbs() - (0.5 * size - Vec3::Constant(rounding));
  const Vec3 sign = p.unaryExpr([](double x) { return x < 0 ? -1.0 : 1.0; });
  const Vec3 out = q.cwiseMax(0.0);
  const double r = out.norm();
  if (r > 0) return {r - rounding, Vec3((out / r).cwiseProduct(sign))};
  Eigen::Index nearest = 0;
  const double inside = q.maxCoeff(&nearest);
  return {inside - rounding, Vec3(sign[nearest] * Vec3::Unit(nearest))};
}

SolidValue shape_value(const SolidPart& part, const Vec3& p) {
  switch (part.shape) {
    case Shape::sphere:
      return ball(p, part.radius);
    case Shape::ellipsoid:
      return ellipsoid(p, part.radii);
    case Shape::rod:
      return rod(p, part);
    case Shape::torus:
      return torus(p, part.radius, part.end_radius);
    case Shape::box:
      return box(p, part.radii, part.radius);
    case Shape::half_space:
      return {p.z(), Vec3::UnitZ()};
  }
  return {};
}

SolidValue negative(const SolidValue& v) { return {-v.f, -v.gradient}; }

/// Half the extent of a shape along each axis of its own frame, about its middle.
void extent(const SolidPart& part, Vec3& low, Vec3& high) {
  high = Vec3::Constant(part.radius);
  if (part.shape == Shape::ellipsoid) high = part.radii;
  if (part.shape == Shape::box) high = 0.5 * part.radii;
  if (part.shape == Shape::torus) high = Vec3(1, 1, 0) * part.radius + Vec3::Constant(part.end_radius);
  low = -high;
  if (part.shape != Shape::rod) return;
  low = (part.from.array() - part.radius).min(part.to.array() - part.end_radius);
  high = (part.from.array() + part.radius).max(part.to.array() + part.end_radius);
}

}  // namespace

SolidValue part_value(const SolidPart& part, const Vec3& x) {
  SolidValue v = shape_value(part, part.placement.R.transpose() * (x - part.placement.p));
  v.gradient = part.placement.R * v.gradient;
  return v;
}

SolidValue smooth_min(const SolidValue& a, const SolidValue& b, double k) {
  const SolidValue &low = a.f < b.f ? a : b, &high = a.f < b.f ? b : a;
  const double apart = high.f - low.f;
  if (!(apart < k)) return low;
  const double h = 1 - apart / k;
  return {low.f - k * h * h * h / 6, (1 - h * h / 2) * low.gradient + h * h / 2 * high.gradient};
}

SolidValue SolidField::operator()(const Vec3& x) const {
  SolidValue v = part_value(parts_.front(), x);
  for (std::size_t k = 1; k < parts_.size(); ++k) {
    const SolidPart& part = parts_[k];
    const SolidValue own = part_value(part, x);
    if (part.operation == Operation::join)
      v = smooth_min(v, own, part.blend);
    else
      v = negative(smooth_min(negative(v), part.operation == Operation::cut ? own : negative(own), part.blend));
  }
  return v;
}

bool SolidField::project(Vec3& x, Vec3& normal) const {
  double last = 0;
  for (int step = 0; step < kMaxFieldSteps; ++step) {
    const SolidValue v = (*this)(x);
    const double square = v.gradient.squaredNorm();
    if (!(square > 0)) return false;
    normal = v.gradient / std::sqrt(square);
    // Once it has arrived, on to where rounding alone is left: flat faces come out flat.
    if (v.f == 0 || (step > 0 && std::abs(v.f) < kFieldArrived && !(std::abs(v.f) < 0.5 * last))) return true;
    last = std::abs(v.f);
    x -= v.f / square * v.gradient;
  }
  return false;
}

BoundingBox SolidField::box() const {
  constexpr double kFar = 1e300;
  BoundingBox out{Vec3::Constant(kFar), Vec3::Constant(-kFar)};
  double swell = 0;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const SolidPart& part = parts_[k];
    if (k > 0 && part.operation != Operation::join) continue;
    if (k > 0) swell += part.blend / 6;
    Vec3 low, high;
    extent(part, low, high);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p((corner & 1) ? high.x() : low.x(), (corner & 2) ? high.y() : low.y(),
                   (corner & 4) ? high.z() : low.z());
      out.low = out.low.cwiseMin(part.placement * p);
      out.high = out.high.cwiseMax(part.placement * p);
    }
  }
  // f grows more slowly than the distance where gradients of parts cancel: twice as far is far enough.
  out.low.array() -= 2 * swell;
  out.high.array() += 2 * swell;
  return out;
}

}  // namespace genu
