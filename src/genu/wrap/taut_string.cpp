#include "genu/wrap/taut_string.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "genu/core/few.h"
#include "genu/wrap/round_string.h"
#include "genu/wrap/tolerances.h"

namespace genu {
namespace {

constexpr int kMostUnknowns = 4 * kMostArcs;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostUnknowns, 1>;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostUnknowns, kMostUnknowns>;

/// Where a leg begins or ends, in the world: a fixed point, or an end of an arc.
struct Tip {
  Vec3 p, t, n, b;
  const Geodesic* arc = nullptr;
  bool at_end = false;     ///< of the arc
  Eigen::Index first = 0;  ///< unknown of the arc: s, y, theta, length

  const ArcEnd& end() const { return at_end ? arc->end : arc->begin; }
};

Tip fixed_tip(const Vec3& p) {
  Tip tip;
  tip.p = p;
  return tip;
}

Tip arc_tip(const Obstacle& obstacle, const Geodesic& arc, bool at_end, std::size_t index) {
  const ArcEnd& end = at_end ? arc.end : arc.begin;
  const Mat3& R = obstacle.X_W.R;
  return {obstacle.X_W * end.p, R * end.t, R * end.n, R * end.b(), &arc, at_end, static_cast<Eigen::Index>(4 * index)};
}

/// Calls f(k, tip, tip) for every leg from end to end.
template <typename F>
void for_each_leg(const Vec3& from, const Vec3& to, std::span<const Obstacle> obstacles, std::span<const Geodesic> arcs,
                  const F& f) {
  Tip last = fixed_tip(from);
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    f(last, arc_tip(obstacles[i], arcs[i], false, i));
    last = arc_tip(obstacles[i], arcs[i], true, i);
  }
  f(last, fixed_tip(to));
}

/// The rates of an end of an arc with its four unknowns.
struct TipRates {
  Eigen::Matrix<double, 1, 4> along = Eigen::Matrix<double, 1, 4>::Zero(), across = along, turn = along;

  explicit TipRates(const Tip& tip) {
    along[0] = 1;
    if (!tip.at_end) {
      across[1] = 1;
      turn[2] = 1;
      return;
    }
    const Geodesic& arc = *tip.arc;
    along[3] = 1;
    across[1] = arc.c, across[2] = arc.a;
    turn[1] = arc.dc, turn[2] = arc.da;
  }
};

struct System {
  Vector residual;  ///< m: d . n and d . b at both ends of each arc
  Matrix jacobian;
  double worst = 0;  ///< rad: largest angle between a leg and its tangent line
  bool forward = true;

  void resize(std::size_t arcs) {
    const auto n = static_cast<Eigen::Index>(4 * arcs);
    residual.setZero(n);
    jacobian.setZero(n, n);
    worst = 0;
    forward = true;
  }

  /// The two conditions of one end of a leg d, that the point `other` ends at the other side; `sign`: of this end in d.
  void add(const Tip& tip, const Tip& other, const Vec3& d, double sign) {
    const Eigen::Index row = tip.first + (tip.at_end ? 2 : 0);
    const double length = d.norm();
    residual[row] = d.dot(tip.n);
    residual[row + 1] = d.dot(tip.b);
    worst = std::max(worst, std::max(std::abs(residual[row]), std::abs(residual[row + 1])) / length);
    forward = forward && d.dot(tip.t) > 0;
    const ArcEnd& end = tip.end();
    const TipRates own(tip);
    // dn = -t (kappa along + tau across) - b (tau along + mu across), db = n (tau along + mu across) - t turn.
    const auto bent_t = end.kappa * own.along + end.tau * own.across;
    const auto bent_b = end.tau * own.along + end.mu * own.across;
    const double dt = d.dot(tip.t), db = residual[row + 1], dn = residual[row];
    jacobian.block<1, 4>(row, tip.first) += -dt * bent_t - db * bent_b;
    jacobian.block<1, 4>(row + 1, tip.first) += dn * bent_b - dt * own.turn + sign * own.across;
    if (other.arc == nullptr) return;
    const TipRates far(other);
    jacobian.block<1, 4>(row, other.first) -= sign * (tip.n.dot(other.t) * far.along + tip.n.dot(other.b) * far.across);
    jacobian.block<1, 4>(row + 1, other.first) -=
        sign * (tip.b.dot(other.t) * far.along + tip.b.dot(other.b) * far.across);
  }
};

/// Newton's step. One arc is what most strings have.
Vector solved(const System& system) {
  if (system.residual.size() != 4) return system.jacobian.partialPivLu().solve(-system.residual);
  const Eigen::Matrix4d jacobian = system.jacobian;
  return jacobian.partialPivLu().solve(-system.residual.head<4>());
}

void set_system(const Vec3& from, const Vec3& to, std::span<const Obstacle> obstacles, std::span<const Geodesic> arcs,
                System& out) {
  out.resize(arcs.size());
  for_each_leg(from, to, obstacles, arcs, [&](const Tip& x, const Tip& y) {
    const Vec3 d = y.p - x.p;
    if (x.arc != nullptr) out.add(x, y, d, -1);
    if (y.arc != nullptr) out.add(y, x, d, 1);
  });
}

/// The share of a step that no arc is moved too far by.
double allowed_share(const Vector& step, std::span<const Geodesic> arcs) {
  double share = 1;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const ArcEnd& a = arcs[i].begin;
    const double bend = std::max({std::abs(a.kappa), std::abs(a.mu), std::abs(a.tau)});
    const auto s = step.segment<4>(static_cast<Eigen::Index>(4 * i));
    const double turn = std::max({bend * std::abs(s[0]), bend * std::abs(s[1]), std::abs(s[2]), bend * std::abs(s[3])});
    share = std::min(share, kMostStringTurn / std::max(turn, 1e-300));
  }
  return share;
}

/// The begin of an arc, moved by a step: to second order, then put onto the surface.
bool moved_begin(const Surface& surface, const ArcEnd& a, const Eigen::Vector4d& step, ArcEnd& out) {
  const Vec3 b = a.b();
  const double s = step[0], y = step[1];
  const double along = a.kappa * s + a.tau * y, across = a.tau * s + a.mu * y;  // how n turns toward -t and -b
  const Vec3 p = a.p + s * a.t + y * b + 0.5 * (along * s + across * y) * a.n;
  const double c = std::cos(step[2]), d = std::sin(step[2]);
  return arc_end(surface, p, c * a.t + d * b + (c * along + d * across) * a.n, out);
}

bool moved(const Surface& surface, const Geodesic& arc, const Eigen::Vector4d& step, double error, Geodesic& out) {
  ArcEnd begin;
  return moved_begin(surface, arc.begin, step, begin) && shoot(surface, begin, arc.length + step[3], out, error);
}

/// The same for a small step: the end moves along the Jacobi fields, which remain as they are.
bool slid(const Surface& surface, const Geodesic& arc, const Eigen::Vector4d& step, double, Geodesic& out) {
  const ArcEnd& e = arc.end;
  const Vec3 b = e.b();
  const double along = step[0] + step[3], across = arc.c * step[1] + arc.a * step[2];
  const Vec3 t = e.t + (arc.dc * step[1] + arc.da * step[2]) * b + (e.kappa * along + e.tau * across) * e.n;
  out = arc;
  out.length += step[3];
  return moved_begin(surface, arc.begin, step, out.begin) &&
         arc_end(surface, e.p + along * e.t + across * b, t, out.end);
}

using Move = bool (*)(const Surface&, const Geodesic&, const Eigen::Vector4d&, double error, Geodesic&);

bool move_all(std::span<const Obstacle> obstacles, std::span<const Geodesic> arcs, const Vector& step, Move move,
              double error, std::span<Geodesic> out) {
  for (std::size_t i = 0; i < arcs.size(); ++i)
    if (!move(*obstacles[i].surface, arcs[i], step.segment<4>(static_cast<Eigen::Index>(4 * i)), error, out[i]))
      return false;
  return true;
}

/// Whether an end of an arc is still where the surface has it.
bool is_on(const Surface& surface, const ArcEnd& e) {
  ArcEnd now;
  if (!arc_end(surface, e.p, e.t, now)) return false;
  const double bend = std::max({std::abs(e.kappa), std::abs(e.tau), std::abs(e.mu), 1 / kFlatReach});
  const double bent = std::max({std::abs(now.kappa - e.kappa), std::abs(now.tau - e.tau), std::abs(now.mu - e.mu)});
  return bend * (now.p - e.p).norm() <= kArcUnchanged && (now.n - e.n).norm() <= kArcUnchanged &&
         (now.t - e.t).norm() <= kArcUnchanged && bent <= kArcUnchanged * bend;
}

/// The string over one sphere or cylinder, to rounding. False where it has to be searched for.
bool place_round(const Vec3& from, const Vec3& to, std::span<const Obstacle> obstacles, std::span<Geodesic> arcs) {
  if (arcs.size() != 1) return false;
  const Obstacle& o = obstacles[0];
  const std::optional<RoundShape> shape = o.surface->round();
  if (!shape) return false;
  const auto in_body = [&](const Vec3& x) -> Vec3 { return o.X_W.R.transpose() * (x - o.X_W.p); };
  Geodesic& arc = arcs[0];
  ArcEnd begin;
  return place_round_arc(*shape, in_body(from), in_body(to), arc) &&
         arc_end(*o.surface, arc.begin.p, arc.begin.t, begin) && shoot(*o.surface, begin, arc.length, arc);
}

/// Follows the arcs that are only begun, or whose surface has changed. One that was solved at a pose nearby is what it
/// was, in the frame of the surface's body.
bool follow_begun(std::span<const Obstacle> obstacles, std::span<Geodesic> arcs) {
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    Geodesic& arc = arcs[i];
    const Surface& surface = *obstacles[i].surface;
    if (arc.a != 0 && std::isfinite(arc.length) && is_on(surface, arc.begin) && is_on(surface, arc.end)) continue;
    ArcEnd begin;
    if (!arc_end(surface, arc.begin.p, arc.begin.t, begin) || !shoot(surface, begin, arc.length, arc)) return false;
  }
  return true;
}

}  // namespace

bool solve_string(const Vec3& from, const Vec3& to, std::span<const Obstacle> obstacles, std::span<Geodesic> arcs) {
  Few<Geodesic, kMostArcs> trial(arcs.size());
  if (!place_round(from, to, obstacles, arcs) && !follow_begun(obstacles, arcs)) return false;
  System system, next;
  set_system(from, to, obstacles, arcs, system);
  bool exact = true;  // the arcs, to rounding: those of trials need not be
  const auto improves = [&](const Vector& step, Move move, double error) {
    if (!move_all(obstacles, arcs, step, move, error, trial)) return false;
    set_system(from, to, obstacles, trial, next);
    return next.worst < system.worst;
  };
  const auto make_exact = [&] {
    exact = true;
    for (std::size_t i = 0; i < arcs.size(); ++i) {
      const ArcEnd begin = arcs[i].begin;
      if (!shoot(*obstacles[i].surface, begin, arcs[i].length, arcs[i])) return false;
    }
    set_system(from, to, obstacles, arcs, system);
    return true;
  };
  for (int iteration = 0; iteration < kMaxStringSteps; ++iteration) {
    if (!exact && system.worst <= kStringSlide && !make_exact()) return false;
    if (system.worst <= kStringSettled) return system.forward;
    const Vector step = solved(system);
    if (!step.allFinite()) return false;
    const bool last = exact && system.worst <= kStringSlide;
    const int halvings = last || system.worst <= kStringRounding ? 1 : kMaxStringHalvings;
    const double error = std::max(kGeodesicError, kTrialError * system.worst * system.worst);
    double share = last ? 1 : allowed_share(step, arcs);
    bool better = false;
    for (int halving = 0; halving < halvings && !better; ++halving, share /= 2)
      better = improves(share * step, last ? slid : moved, error);
    if (better) {
      std::copy(trial.begin(), trial.end(), arcs.begin());
      std::swap(system, next);
      exact = last || error == kGeodesicError;
    } else if (!exact) {
      if (!make_exact()) return false;
      continue;
    }
    // Rounding decides: no step makes a settled string better.
    if (last || !better) return system.worst <= kStringRounding && system.forward;
  }
  return false;
}

double string_length(const Vec3& from, const Vec3& to, std::span<const Obstacle> obstacles,
                     std::span<const Geodesic> arcs) {
  double length = 0;
  for_each_leg(from, to, obstacles, arcs, [&](const Tip& x, const Tip& y) { length += (y.p - x.p).norm(); });
  for (const Geodesic& arc : arcs) length += arc.length;
  return length;
}

void string_hessian(const Vec3& from, const Vec3& to, std::span<const Obstacle> obstacles,
                    std::span<const Geodesic> arcs, StringHessian& out) {
  const auto n = static_cast<Eigen::Index>(2 * arcs.size());
  out.H.setZero(n, n);
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const Geodesic& arc = arcs[i];
    const double sign = arc.a < 0 ? -1 : 1, root = std::sqrt(std::abs(arc.a));
    const auto k = static_cast<Eigen::Index>(2 * i);
    out.H(k, k) = arc.c * arc.dc;
    out.H(k, k + 1) = out.H(k + 1, k) = sign * root * arc.dc;
    out.H(k + 1, k + 1) = sign * arc.da;
    out.at_begin[i] = Vec2(1, 0);
    out.at_end[i] = Vec2(arc.c, sign * root);
  }
  for_each_leg(from, to, obstacles, arcs, [&](const Tip& x, const Tip& y) {
    const double stiffness = 1 / (y.p - x.p).norm();
    const auto move = [&](const Tip& tip) -> const Vec2& {
      const auto i = static_cast<std::size_t>(tip.first / 4);
      return tip.at_end ? out.at_end[i] : out.at_begin[i];
    };
    for (const Tip* tip : {&x, &y})
      if (tip->arc != nullptr)
        out.H.block<2, 2>(tip->first / 2, tip->first / 2) += stiffness * move(*tip) * move(*tip).transpose();
    if (x.arc == nullptr || y.arc == nullptr) return;
    const Mat2 both = -stiffness * x.b.dot(y.b) * move(x) * move(y).transpose();
    out.H.block<2, 2>(x.first / 2, y.first / 2) += both;
    out.H.block<2, 2>(y.first / 2, x.first / 2) += both.transpose();
  });
}

bool is_shortest_nearby(const StringHessian& hessian, std::span<const Geodesic> arcs) {
  for (const Geodesic& arc : arcs)
    if (arc.length > 0 && arc.conjugate) return false;
  return hessian.H.llt().info() == Eigen::Success;
}

double least_hold(const StringHessian& hessian) {
  const MatX H = hessian.H;
  const Eigen::SelfAdjointEigenSolver<MatX> solver(H, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().minCoeff() / solver.eigenvalues().cwiseAbs().maxCoeff();
}

namespace {

/// The least distance (m) of the segment from the axis, or from the centre.
double round_clearance(const RoundShape& shape, const Vec3& from, const Vec3& to, double& along) {
  const auto away = [&](const Vec3& x) -> Vec3 {
    const Vec3 d = x - shape.centre;
    return d - shape.axis.dot(d) * shape.axis;
  };
  const Vec3 a = away(from), d = away(to) - a;
  const double square = d.squaredNorm();
  if (shape.inside) {
    along = away(to).norm() > a.norm() ? 1 : 0;
    return shape.radius - (a + along * d).norm();
  }
  along = square > 0 ? std::clamp(-a.dot(d) / square, 0.0, 1.0) : 0;
  return (a + along * d).norm() - shape.radius;
}

}  // namespace

double line_clearance(const Surface& surface, const Vec3& from, const Vec3& to, double& along) {
  if (const auto shape = surface.round()) return round_clearance(*shape, from, to, along);
  const Vec3 d = to - from;
  const double length = d.norm(), smooth = surface.smooth_length();
  const int steps = std::isfinite(smooth) ? std::clamp(static_cast<int>(length / (kClearanceStep * smooth)), 8, 2000)
                                          : kClearanceLooks;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  struct Look {
    double u = 0, gap = infinity, slope = 0;
  };
  const auto look = [&](double u) {
    Look out{u};
    SurfacePoint foot;
    const Vec3 x = from + u * d;
    const auto gap = surface.gap(x);
    if (!gap || !surface.project(x, foot)) return out;
    out.gap = *gap;
    out.slope = foot.n.dot(d);
    return out;
  };
  Look best;
  const auto keep = [&](const Look& l) {
    if (l.gap < best.gap) best = l;
  };
  Look last = look(0);
  keep(last);
  for (int k = 1; k <= steps; ++k) {
    const Look next = look(static_cast<double>(k) / steps);
    keep(next);
    if (last.gap < infinity && next.gap < infinity && last.slope < 0 && next.slope > 0) {
      // A minimum between: regula falsi of the slope, safeguarded.
      Look low = last, high = next;
      for (int i = 0; i < kMaxClearanceSteps && low.gap < infinity; ++i) {
        const double secant = low.u - low.slope * (high.u - low.u) / (high.slope - low.slope);
        const double u = i % 3 == 2 ? 0.5 * (low.u + high.u) : secant;
        const Look middle = look(u);
        keep(middle);
        if (std::abs(middle.slope) <= kClearanceSlope * length || !(high.u - low.u > kClearanceSlope)) break;
        (middle.slope < 0 ? low : high) = middle;
      }
    }
    last = next;
  }
  along = best.u;
  return best.gap;
}

}  // namespace genu
