#include "genu/surface/polynomial_surface.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "genu/surface/analytic_placed.h"
#include "genu/surface/tolerances.h"

namespace genu {

SurfacePoint surface_point(const ChartJet& jet) {
  SurfacePoint s;
  s.p = jet.p;
  s.n = jet.u.cross(jet.v).normalized();
  const double length = jet.u.norm();
  s.T.col(0) = jet.u / length;
  s.T.col(1) = s.n.cross(s.T.col(0));
  // [u v] = T J; the second fundamental form in the chart becomes J^-T II J^-1 in the basis T.
  const double J01 = jet.v.dot(s.T.col(0)), J11 = jet.v.dot(s.T.col(1));
  Mat2 A;  // J^-1, J = [length J01; 0 J11]
  A << 1 / length, -J01 / (length * J11), 0, 1 / J11;
  Mat2 second;
  second << jet.uu.dot(s.n), jet.uv.dot(s.n), jet.uv.dot(s.n), jet.vv.dot(s.n);
  s.S = A.transpose() * second * A;
  s.S(1, 0) = s.S(0, 1);
  return s;
}

namespace {

/// A surface given by a chart: subclass by Chart with coordinates(x) of the point "above" x, jet(u), false where the
/// chart does not reach, side(x) > 0 where x is outside, and start_mesh.
template <class Chart>
struct ChartSurface : Chart {
  static constexpr bool kUnbounded = true;
  // its foot points are descents from above: near the surface the nearest, far away only one of several
  static constexpr bool kKnowsDistance = false;

  /// Newton on the squared distance |p(u, v) - x|^2 / 2 from the point above x, on its convex part; where it is not
  /// convex, Gauss-Newton (whose matrix is the metric, always definite); every step must lower the distance.
  bool project(const Vec3& x, SurfacePoint& out) const {
    Vec2 u;
    ChartJet jet;
    if (!x.allFinite() || !this->coordinates(x, u) || !this->jet(u, jet)) return false;
    double value = 0.5 * (jet.p - x).squaredNorm(), before = kUnknownStep;
    for (int k = 0, polished = 0; k < kMaxProjectionSteps; ++k) {
      const Vec3 d = jet.p - x;
      const Vec2 gradient(jet.u.dot(d), jet.v.dot(d));
      const auto [step, newton] = newton_step(jet, d, gradient);
      const double length = (jet.u * step.x() + jet.v * step.y()).norm();
      const double scale = jet.p.norm() + x.norm();
      if (!std::isfinite(length)) return false;
      if (length <= kProjectionBasin * scale) {
        // Rounding hides what such a step takes off the distance, so no decrease is asked for. Quadratic convergence
        // makes the second of them the last, or the first where the one after it would be lost in rounding.
        u += step;
        if (!this->jet(u, jet)) return false;
        if (++polished == 2 || next_is_lost(length, before, newton, scale)) return accept(jet, out);
      } else if (!descend(x, u, step, gradient, value, jet)) {
        return false;
      }
      before = newton ? length : kUnknownStep;
    }
    return false;
  }

  /// Keeps the chart coordinates of the second-order step: no search for a foot, and the same to second order.
  bool retract(const SurfacePoint& from, const Vec2& ds, SurfacePoint& out) const {
    const Vec3 x = from.p + from.T * ds + 0.5 * ds.dot(from.S * ds) * from.n;
    Vec2 u;
    ChartJet jet;
    return x.allFinite() && this->coordinates(x, u) && this->jet(u, jet) && accept(jet, out);
  }

  std::optional<double> gap(const Vec3& x) const {
    SurfacePoint foot;
    if (!project(x, foot)) return std::nullopt;
    return std::copysign((x - foot.p).norm(), this->side(x));
  }

 private:
  static bool accept(const ChartJet& jet, SurfacePoint& out) {
    out = surface_point(jet);
    return out.p.allFinite() && out.n.allFinite() && out.S.allFinite();
  }

  /// No length of a step that quadratic convergence could be read from: the first step, or after Gauss-Newton.
  static constexpr double kUnknownStep = 0;

  /// Where convergence is quadratic, steps fall as length / before^2: whether the next one is below rounding.
  static bool next_is_lost(double length, double before, bool newton, double scale) {
    if (!newton || before == kUnknownStep) return false;
    const double next = length * (length / before) * (length / before);
    return next <= kProjectionRounding * scale;
  }

  struct Step {
    Vec2 du;
    bool newton;  ///< or Gauss-Newton, which converges linearly
  };

  static Step newton_step(const ChartJet& jet, const Vec3& d, const Vec2& gradient) {
    const double E = jet.u.dot(jet.u), F = jet.u.dot(jet.v), G = jet.v.dot(jet.v);
    Mat2 H;
    H << E + jet.uu.dot(d), F + jet.uv.dot(d), F + jet.uv.dot(d), G + jet.vv.dot(d);
    const double metric = E * G - F * F;
    const bool convex = H.determinant() > kConvexShare * metric && H(0, 0) > 0;
    if (!convex) H << E, F, F, G;
    const double determinant = H(0, 0) * H(1, 1) - H(0, 1) * H(0, 1);
    return {Vec2(H(0, 1) * gradient.y() - H(1, 1) * gradient.x(), H(0, 1) * gradient.x() - H(0, 0) * gradient.y()) /
                determinant,
            convex};
  }

  /// Halves the step until the distance falls; false where none does. Moves u, value and jet only on success.
  bool descend(const Vec3& x, Vec2& u, const Vec2& step, const Vec2& gradient, double& value, ChartJet& jet) const {
    double share = 1;
    for (int halvings = 0; halvings < 40; ++halvings, share *= 0.5) {
      const Vec2 next = u + share * step;
      ChartJet trial;
      if (!this->jet(next, trial)) continue;
      const double trial_value = 0.5 * (trial.p - x).squaredNorm();
      if (trial_value <= value + kSufficientDecrease * share * gradient.dot(step) && trial_value < value) {
        u = next;
        value = trial_value;
        jet = trial;
        return true;
      }
    }
    return false;
  }
};

/// z = P(x, y), outward +z.
struct CartesianChart {
  Polynomial P;

  bool coordinates(const Vec3& x, Vec2& u) const {
    u = x.head<2>();
    return true;
  }
  double side(const Vec3& x) const { return x.z() - P.value(x.x(), x.y()); }

  bool jet(const Vec2& u, ChartJet& out) const {
    const PolynomialJet f = P(u.x(), u.y());
    out = {{u.x(), u.y(), f.f}, {1, 0, f.x}, {0, 1, f.y}, {0, 0, f.xx}, {0, 0, f.xy}, {0, 0, f.yy}};
    return true;
  }

  Mesh start_mesh(double edge, const Vec3& centre, double reach) const {
    const int n = grid_count(2 * reach, affordable_edge(edge, 4 * reach * reach));
    Mesh mesh = grid_mesh({n, false}, {n, false}, [&](double s, double t) {
      const double x = centre.x() + reach * (2 * s - 1), y = centre.y() + reach * (2 * t - 1);
      return Vec3(x, y, P.value(x, y));
    });
    const Vec3 foot(centre.x(), centre.y(), P.value(centre.x(), centre.y()));
    keep_near(mesh, foot, 2 * reach);  // a steep polynomial may leave the neighbourhood
    return mesh;
  }
};

/// r = P(theta, z), outward away from the axis z.
struct CylindricalChart {
  Polynomial P;

  bool coordinates(const Vec3& x, Vec2& u) const {
    if (x.x() == 0 && x.y() == 0) return false;
    u = Vec2(std::atan2(x.y(), x.x()), x.z());
    return true;
  }
  double side(const Vec3& x) const { return std::hypot(x.x(), x.y()) - P.value(std::atan2(x.y(), x.x()), x.z()); }

  /// Where r is positive; past theta = pi the polynomial is not the surface any more, unless it turns with it.
  bool jet(const Vec2& u, ChartJet& out) const {
    const PolynomialJet r = P(u.x(), u.y());
    if (!(r.f > 0) || (P.depends_on_x() && std::abs(u.x()) > kPi)) return false;
    const Vec3 e(std::cos(u.x()), std::sin(u.x()), 0), t(-e.y(), e.x(), 0);
    out = {r.f * e + u.y() * Vec3::UnitZ(), r.x * e + r.f * t,  r.y * e + Vec3::UnitZ(),
           (r.xx - r.f) * e + 2 * r.x * t,  r.xy * e + r.y * t, r.yy * e};
    return true;
  }

  Mesh start_mesh(double edge, const Vec3& centre, double reach) const {
    const double radius = std::abs(P.value(0, centre.z()));
    const double local = affordable_edge(graded_edge(edge, radius), 4 * kPi * radius * reach);
    const int around = grid_count(2 * kPi * radius, local);
    const int along = grid_count(2 * reach, kRowSpacing * local);
    const bool closed = !P.depends_on_x();
    // An open surface stops just short of the cut at theta = pi, where rounding would choose between its two sides.
    const double end = closed ? kPi : kPi * (1 - 1e-6);
    Mesh mesh = grid_mesh({around, closed}, {along, false}, [&](double s, double t) {
      const double theta = end * (2 * s - 1), z = centre.z() + reach * (2 * t - 1), r = P.value(theta, z);
      return Vec3(r * std::cos(theta), r * std::sin(theta), z);
    });
    keep_near(mesh, Vec3(0, 0, centre.z()), 2 * (reach + radius));
    return mesh;
  }
};

bool valid(const std::vector<PolynomialTerm>& terms) {
  return !terms.empty() && std::all_of(terms.begin(), terms.end(), [](const PolynomialTerm& t) {
    return t.i >= 0 && t.j >= 0 && t.i <= kMaxPolynomialExponent && t.j <= kMaxPolynomialExponent && std::isfinite(t.c);
  });
}

template <class Chart>
std::unique_ptr<Surface> make(const Pose& X_BS, const std::vector<PolynomialTerm>& terms, bool inside) {
  if (!valid(terms)) return nullptr;
  return std::make_unique<Placed<ChartSurface<Chart>>>(X_BS, inside, ChartSurface<Chart>{{Polynomial(terms)}});
}

}  // namespace

std::unique_ptr<Surface> make_polynomial(const Pose& X_BS, const std::vector<PolynomialTerm>& terms, bool inside) {
  return make<CartesianChart>(X_BS, terms, inside);
}

std::unique_ptr<Surface> make_cylindrical_polynomial(const Pose& X_BS, const std::vector<PolynomialTerm>& terms,
                                                     bool inside) {
  return make<CylindricalChart>(X_BS, terms, inside);
}

}  // namespace genu
