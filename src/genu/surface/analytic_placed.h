// Puts a shape that knows only its own frame into a body. For the .cpp files of the analytic surfaces alone.
//
// A Shape is a plain struct with, all in its own frame and with its own outward side:
//   bool project(const Vec3& x, SurfacePoint& out) const
//   std::optional<double> gap(const Vec3& x) const
//   Mesh start_mesh(double edge, const Vec3& centre, double reach) const   (to be refined where it is too coarse)
//   static constexpr bool kUnbounded, kKnowsDistance  (see Surface::is_unbounded, knows_distance)
// and, where it has a better one than the default, bool retract(const SurfacePoint&, const Vec2&, SurfacePoint&) const
// and bool bending(const Vec3& x, const Vec3& t, Bending& out) const. A sphere or cylinder has Vec3 axis() const.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "genu/surface/surface.h"
#include "genu/surface/tessellate.h"

namespace genu {

inline constexpr double kPi = std::numbers::pi;

/// A length that can be a radius.
inline bool is_radius(double r) { return std::isfinite(r) && r > 0; }

/// The same point with the other side outward; T.col(1) turns with n, so that the basis stays right-handed. The
/// off-diagonal of S changes sign twice.
inline void turn_inside_out(SurfacePoint& s) {
  s.n = -s.n;
  s.T.col(1) = -s.T.col(1);
  s.S(0, 0) = -s.S(0, 0);
  s.S(1, 1) = -s.S(1, 1);
}

template <class Shape>
class Placed final : public Surface {
 public:
  Placed(const Pose& X_BS, bool inside, Shape shape) : X_BS_(X_BS), inside_(inside), shape_(std::move(shape)) {}

  bool project(const Vec3& x, SurfacePoint& out) const override {
    if (!shape_.project(to_shape(x), out)) return false;
    to_body(out);
    return true;
  }

  bool retract(const SurfacePoint& from, const Vec2& ds, SurfacePoint& out) const override {
    if constexpr (requires { shape_.retract(from, ds, out); }) {
      SurfacePoint local = from;
      local.p = to_shape(from.p);
      local.n = X_BS_.R.transpose() * from.n;
      local.T = X_BS_.R.transpose() * from.T;
      // S and n change sign together, so their product, all that a retraction reads, does not: no need to turn `local`.
      if (!shape_.retract(local, ds, out)) return false;
      to_body(out);
      return true;
    } else {
      return Surface::retract(from, ds, out);
    }
  }

  bool bending(const Vec3& x, const Vec3& t, Bending& out) const override {
    if constexpr (requires { shape_.bending(x, t, out); }) {
      if (!shape_.bending(to_shape(x), X_BS_.R.transpose() * t, out)) return false;
      out.n = X_BS_.R * out.n;
      if (inside_) out.n = -out.n, out.normal_curvature = -out.normal_curvature;
      return true;
    } else {
      return Surface::bending(x, t, out);
    }
  }

  std::optional<RoundShape> round() const override {
    if constexpr (requires { shape_.axis(); })
      return RoundShape{X_BS_.p, X_BS_.R * shape_.axis(), shape_.radius, inside_};
    else
      return std::nullopt;
  }

  std::optional<double> gap(const Vec3& x) const override {
    const std::optional<double> g = shape_.gap(to_shape(x));
    return g && inside_ ? -*g : g;
  }

  Mesh triangles(double edge, const Vec3& centre, double reach) const override {
    Mesh mesh = shape_.start_mesh(edge, to_shape(centre), reach);
    for (Vec3& v : mesh.vertices) v = X_BS_ * v;
    if (inside_) {
      for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    }
    refine(mesh, *this, edge);
    return mesh;
  }

  bool is_unbounded() const override { return Shape::kUnbounded; }
  bool knows_distance() const override { return Shape::kKnowsDistance; }

 private:
  Vec3 to_shape(const Vec3& x) const { return X_BS_.R.transpose() * (x - X_BS_.p); }

  void to_body(SurfacePoint& s) const {
    s.p = X_BS_ * s.p;
    s.n = X_BS_.R * s.n;
    s.T = X_BS_.R * s.T;
    if (inside_) turn_inside_out(s);
  }

  Pose X_BS_;
  bool inside_;
  Shape shape_;
};

}  // namespace genu
