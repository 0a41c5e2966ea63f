#include "genu/wrap/geodesic.h"

#include <algorithm>
#include <cmath>

namespace genu {
namespace {

/// Of a geodesic and its two Jacobi fields: x (3), t (3), c, c', a, a'.
using Values = Eigen::Matrix<double, 10, 1>;

/// Follows the geodesic with everything that is to be known on the way.
class Shooter {
 public:
  Shooter(const Surface& surface, const ArcEnd& begin, double length, double error, Geodesic& out)
      : surface_(surface), length_(length), sign_(length < 0 ? -1 : 1), error_(error), out_(out) {
    y_ << begin.p, sign_ * begin.t, 1, 0, 0, 1;
    scale_ = 1 / std::max({std::abs(begin.kappa), std::abs(begin.mu), std::abs(begin.tau), 1e-300});
    out.most_hollow = -std::numeric_limits<double>::infinity();
    out.conjugate = false;
  }

  bool run() {
    const double smooth = surface_.smooth_length();
    if (!(std::isfinite(smooth) ? by_pieces(kGeodesicStep * smooth) : extrapolated())) return false;
    out_.hollow_length = std::abs(length_) * hollows_ / looks_;
    out_.c = y_[6];
    out_.dc = sign_ * y_[7];
    out_.a = sign_ * y_[8];
    out_.da = y_[9];
    return arc_end(surface_, y_.head<3>(), sign_ * y_.segment<3>(3), out_.end);
  }

 private:
  bool slope(const Values& y, Values& out) {
    Bending bending;
    if (!surface_.bending(y.head<3>(), y.segment<3>(3), bending)) return false;
    out << y.segment<3>(3), bending.normal_curvature * bending.n, y[7], -bending.gauss * y[6], y[9],
        -bending.gauss * y[8];
    kappa_ = bending.normal_curvature;
    return true;
  }

  void watch(double s, double a) {
    ++looks_;
    hollows_ += kappa_ > 0;
    if (kappa_ > out_.most_hollow) out_.most_hollow = kappa_, out_.hollow_at = s;
    out_.conjugate = out_.conjugate || (s > 0 && !(a > 0));
  }

  /// Classical Runge-Kutta steps: a blend has no more derivatives than they use.
  bool by_pieces(double longest) {
    const double whole = std::abs(length_);
    const int steps = std::max(1, static_cast<int>(std::ceil(whole / longest)));
    const double h = whole / steps;
    Values k1, k2, k3, k4;
    for (int i = 0; i < steps; ++i) {
      if (!slope(y_, k1)) return false;
      watch(i * h, y_[8]);
      if (!slope(y_ + h / 2 * k1, k2) || !slope(y_ + h / 2 * k2, k3) || !slope(y_ + h * k3, k4)) return false;
      y_ += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return note_end(whole);
  }

  bool note_end(double s) {
    Values unused;
    if (!slope(y_, unused)) return false;
    watch(s, y_[8]);
    return true;
  }

  /// Gragg, Bulirsch and Stoer: modified midpoint rules of 2, 4, ... substeps, extrapolated to none in the square of
  /// the substep.
  bool extrapolated() {
    const double whole = std::abs(length_);
    double done = 0, h = std::min(whole, kFirstStepTurn * scale_);
    for (int trials = 0; done < whole; ++trials) {
      if (trials > kMaxGeodesicSteps) return false;
      const bool last = h >= whole - done;
      if (last) h = whole - done;
      Values next;
      const Geodesic before = out_;
      const int rows = step(done, h, next);
      if (rows < 0) return false;
      if (rows > kRows) {
        out_ = before;
        h *= 0.5;
        continue;
      }
      y_ = next;
      done = last ? whole : done + h;
      h *= rows < kRows - 2 ? 1.7 : rows < kRows ? 1.1 : 0.8;
    }
    return note_end(whole);
  }

  static constexpr int kRows = 7;

  /// One step; how many rules it took, kRows + 1 where they do not agree, -1 off the surface.
  int step(double done, double h, Values& out) {
    std::array<Values, kRows> table;
    Values first;
    if (!slope(y_, first)) return -1;
    watch(done, y_[8]);
    for (int row = 0; row < kRows; ++row) {
      const int n = 2 * (row + 1);
      if (!midpoints(done, h, n, first, table[static_cast<std::size_t>(row)])) return -1;
      // Aitken and Neville, in place from the last row up.
      for (int k = row - 1; k >= 0; --k) {
        const double ratio = static_cast<double>(n) / (2 * (k + 1)), factor = ratio * ratio - 1;
        auto& lower = table[static_cast<std::size_t>(k)];
        const Values& upper = table[static_cast<std::size_t>(k) + 1];
        lower = upper + (upper - lower) / factor;
      }
      if (row == 0 || !(size(table[0] - table[1]) <= error_)) continue;
      out = table[0];
      return row + 1;
    }
    return kRows + 1;
  }

  /// Of a difference, without unit.
  double size(const Values& d) const {
    const double r = scale_;
    return std::max({d.head<3>().cwiseAbs().maxCoeff() / r, d.segment<3>(3).cwiseAbs().maxCoeff(), std::abs(d[6]),
                     std::abs(d[7]) * r, std::abs(d[8]) / r, std::abs(d[9])});
  }

  bool midpoints(double done, double h, int n, const Values& first, Values& out) {
    const double sub = h / n;
    Values before = y_, now = y_ + sub * first, rate;
    for (int i = 1; i < n; ++i) {
      if (!slope(now, rate)) return false;
      watch(done + i * sub, now[8]);
      const Values next = before + 2 * sub * rate;
      before = now;
      now = next;
    }
    if (!slope(now, rate)) return false;
    out = 0.5 * (now + before + sub * rate);
    return true;
  }

  const Surface& surface_;
  double length_, sign_, error_, scale_ = 1, kappa_ = 0;
  int looks_ = 0, hollows_ = 0;
  Values y_;
  Geodesic& out_;
};

/// A great circle: begin, `angle` on.
void shoot_sphere(double radius, double side, double angle, Geodesic& out) {
  const double c = std::cos(angle), s = std::sin(angle);
  const Vec3 up = side * out.begin.n, t = out.begin.t;  // away from the centre
  const Vec3 turned = c * up + s * t;
  out.end = out.begin;
  out.end.p += radius * (turned - up);
  out.end.t = (c * t - s * up).normalized();
  out.end.n = side * turned.normalized();
  out.c = out.da = c;
  out.a = radius * s;
  out.dc = -s / radius;
  out.conjugate = std::abs(angle) >= EIGEN_PI;
}

/// A helix: the plane, rolled up.
void shoot_cylinder(const RoundShape& shape, double side, Geodesic& out) {
  const Vec3 up = side * out.begin.n, round = shape.axis.cross(up), &t = out.begin.t;
  const double along = t.dot(shape.axis), around = t.dot(round), angle = around * out.length / shape.radius;
  const double c = std::cos(angle), s = std::sin(angle);
  const Vec3 turned = c * up + s * round;
  out.end = out.begin;
  out.end.p += shape.radius * (turned - up) + along * out.length * shape.axis;
  out.end.t = (around * (c * round - s * up) + along * shape.axis).normalized();
  out.end.n = side * turned.normalized();
  out.c = out.da = 1;
  out.dc = 0;
  out.a = out.length;
  out.conjugate = false;
}

}  // namespace

bool arc_end(const Surface& surface, const Vec3& p, const Vec3& t, ArcEnd& out) {
  SurfacePoint point;
  if (!surface.project(p, point)) return false;
  const Vec3 along = t - point.n.dot(t) * point.n;
  const double length = along.norm();
  if (!(length > kLeastTangent * t.norm())) return false;
  out.p = point.p;
  out.n = point.n;
  out.t = along / length;
  const Vec2 u = point.T.transpose() * out.t, v(-u.y(), u.x());  // b in the basis: n x t
  const Vec2 bent = point.S * u;
  out.kappa = u.dot(bent);
  out.tau = v.dot(bent);
  out.mu = v.dot(point.S * v);
  return true;
}

bool shoot(const Surface& surface, const ArcEnd& begin, double length, Geodesic& out, double error) {
  out.begin = begin;
  out.length = length;
  if (!std::isfinite(length)) return false;
  const std::optional<RoundShape> shape = surface.round();
  if (!shape) return Shooter(surface, begin, length, error, out).run();
  out.most_hollow = begin.kappa;
  out.hollow_at = 0;
  out.hollow_length = begin.kappa > 0 ? std::abs(length) : 0;
  const double side = shape->inside ? -1 : 1;
  shape->axis.isZero() ? shoot_sphere(shape->radius, side, length / shape->radius, out)
                       : shoot_cylinder(*shape, side, out);
  return true;
}

}  // namespace genu
