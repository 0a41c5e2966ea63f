// The charts of Wismans' polynomials: where over a plane, or round an axis, a point of a surface lies, and how high.
#pragma once

#include <cmath>

#include "genu/core/pose.h"

namespace genu {

/// Chart coordinates of a point: (x, y, z) of a cartesian chart, (theta, z, r) of a cylindrical one; m and rad.
struct ChartPoint {
  double u = 0, v = 0, h = 0;
};

/// A chart in its body. Cartesian: h = z over (x, y). Cylindrical: h = r over (theta, z), theta from x toward y.
struct SurfaceChart {
  bool cylindrical = false;
  Pose X_BS;  ///< the chart's frame in the body

  Vec3 to_own(const Vec3& p_B) const { return X_BS.R.transpose() * (p_B - X_BS.p); }

  ChartPoint coordinates(const Vec3& p_B) const {
    const Vec3 p = to_own(p_B);
    if (!cylindrical) return {p.x(), p.y(), p.z()};
    return {std::atan2(p.y(), p.x()), p.z(), std::hypot(p.x(), p.y())};
  }

  Vec3 position(const ChartPoint& c) const {
    if (!cylindrical) return X_BS * Vec3(c.u, c.v, c.h);
    return X_BS * Vec3(c.h * std::cos(c.u), c.h * std::sin(c.u), c.v);
  }

  /// The unit direction, in the body, in which h grows at a point: z, or away from the axis. Zero on the axis.
  Vec3 upward(const Vec3& p_B) const {
    if (!cylindrical) return X_BS.R.col(2);
    Vec3 p = to_own(p_B);
    p.z() = 0;
    const double r = p.norm();
    return r > 0 ? Vec3(X_BS.R * (p / r)) : Vec3::Zero();
  }
};

/// A rectangle of chart coordinates.
struct ChartBox {
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;

  bool contains(double u, double v) const { return u >= u0 && u <= u1 && v >= v0 && v <= v1; }
  double width() const { return u1 - u0; }
  double height() const { return v1 - v0; }
  ChartBox grown(double du, double dv) const { return {u0 - du, u1 + du, v0 - dv, v1 + dv}; }
};

}  // namespace genu
