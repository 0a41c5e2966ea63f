#include "genu/wrap/round_string.h"

#include <cmath>

#include "genu/wrap/tolerances.h"

namespace genu {
namespace {

/// A point, as seen across the axis.
struct Seen {
  Vec3 across;         ///< m: from the axis
  double away = 0;     ///< m: its length
  double tangent = 0;  ///< m: from the point to where its tangent touches
  bool outside = false;

  Seen(const Vec3& x, const Vec3& axis, double radius)
      : across(x - axis.dot(x) * axis), away(across.norm()), outside(away > radius) {
    tangent = outside ? std::sqrt((away - radius) * (away + radius)) : 0;
  }

  /// The direction from the axis to where the tangent touches that leaves the point about the axis, in the sense of it
  /// (1) or against it (-1).
  Vec3 touch(const Vec3& axis, double radius, double sense) const {
    return (radius * across + sense * tangent * axis.cross(across)) / (away * away);
  }
};

}  // namespace

bool place_round_arc(const RoundShape& shape, const Vec3& from, const Vec3& to, Geodesic& arc) {
  if (shape.inside || !std::isfinite(arc.length)) return false;
  const Vec3 p = from - shape.centre, q = to - shape.centre;
  const bool sphere = shape.axis.isZero();
  const Vec3 up = arc.begin.p - shape.centre, turned = up.cross(arc.begin.t);
  Vec3 axis = shape.axis;
  if (sphere) {
    // The plane of the centre and both points; the sense is that of the arc.
    axis = p.cross(q);
    const double size = axis.norm();
    if (!(size > kLeastTangent * p.norm() * q.norm())) return false;
    axis /= size;
  }
  // About the axis, in the sense of the arc.
  const double sense = axis.dot(turned), around = std::abs(sense) / (up - shape.axis.dot(up) * shape.axis).norm();
  if (!(around > kLeastTangent * arc.begin.t.norm())) return false;
  if (sense < 0) axis = -axis;
  const double r = shape.radius;
  const Seen first(p, axis, r), last(q, axis, r);
  if (!first.outside || !last.outside) return false;
  const Vec3 a = first.touch(axis, r, 1), b = last.touch(axis, r, -1);
  double angle = std::atan2(axis.dot(a.cross(b)), a.dot(b));
  const double before = around * arc.length / r;
  angle += 2 * EIGEN_PI * std::round((before - angle) / (2 * EIGEN_PI));
  // Unrolled, the string is straight: it climbs along the axis as far as it goes round.
  const double round = first.tangent + r * angle + last.tangent, climb = sphere ? 0 : axis.dot(q - p);
  if (!(round > 0)) return false;
  const double steep = climb / round, stretch = std::hypot(1, steep);
  arc.begin.p = shape.centre + r * a + (sphere ? 0 : axis.dot(p) + steep * first.tangent) * axis;
  arc.begin.t = (axis.cross(a) + steep * axis) / stretch;
  arc.length = stretch * r * angle;
  return true;
}

}  // namespace genu
