#include "genu/contact/local_minimum.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "genu/contact/tolerances.h"
#include "genu/core/decompositions.h"

namespace genu {
namespace {

/// A point of B, its foot on A, and the gap between them with its first two derivatives over B's tangent plane.
struct GapJet {
  SurfacePoint a, b;
  double value = 0;  ///< m
  Vec2 gradient = Vec2::Zero();
  Mat2 hessian = Mat2::Zero();  ///< 1/m
};

/// `foot`: what A.project gives for the point of B, where that is known.
bool evaluate_gap(const Surface& A, const Pose& X_ab, const SurfacePoint* foot, GapJet& jet) {
  const Vec3 x = X_ab * jet.b.p;
  if (foot != nullptr)
    jet.a = *foot;
  else if (!A.project(x, jet.a))
    return false;
  if (!closest_point(A, x, jet.a)) return false;
  jet.value = jet.a.n.dot(x - jet.a.p);
  const Mat32 T_b = X_ab.R * jet.b.T;
  const double opposed = jet.a.n.dot(X_ab.R * jet.b.n);
  jet.gradient = T_b.transpose() * jet.a.n;
  // Hessian of the distance to A at height `value` over the foot: -S (I - value S)^-1 (for a sphere 1/(R + value)).
  const Mat2 distance_hessian = -jet.a.S * (Mat2::Identity() - jet.value * jet.a.S).inverse();
  const Mat2 turn = jet.a.T.transpose() * T_b;
  jet.hessian = opposed * jet.b.S + turn.transpose() * distance_hessian * turn;
  return jet.gradient.allFinite() && jet.hessian.allFinite();
}

/// The direction in which the gap curves down, scaled to `radius`; empty at a minimum.
std::optional<Vec2> way_off_a_saddle(const GapJet& jet, double radius) {
  const SymmetricEigen<2> eigen = symmetric_eigen(Mat2(0.5 * (jet.hessian + jet.hessian.transpose())));
  if (eigen.values[0] >= -kSaddleCurvature) return std::nullopt;
  return radius * eigen.vectors.col(0);
}

/// Minimiser of the quadratic model within `radius`: Newton's step where the model is convex, else the shifted step,
/// whose length is the radius to within 0.1 %.
Vec2 trust_step(const GapJet& jet, double radius) {
  const SymmetricEigen<2> eigen = symmetric_eigen(Mat2(0.5 * (jet.hessian + jet.hessian.transpose())));
  const Vec2 g = eigen.vectors.transpose() * jet.gradient;
  const Vec2 d = eigen.values;
  auto step = [&](double shift) { return Vec2(-g.x() / (d.x() + shift), -g.y() / (d.y() + shift)); };
  const double gradient = g.norm();
  if (gradient == 0) return Vec2::Zero();
  if (d.x() > 0 && step(0).norm() <= radius) return eigen.vectors * step(0);
  // |step(shift)| decreases with the shift, between "just convex" and "surely inside". Newton's method on its inverse,
  // which is nearly linear (Moré and Sorensen 1983); bisection where that leaves the bracket.
  double low = std::max(0.0, -d.x()), high = low + gradient / radius + std::abs(d.y()), shift = high;
  for (int i = 0; i < 60; ++i) {
    const Vec2 s = step(shift);
    const double length = s.norm();
    if (length <= radius && length >= (1 - kTrustLengthTolerance) * radius) break;
    (length > radius ? low : high) = shift;
    const double slope = s.x() * s.x() / (d.x() + shift) + s.y() * s.y() / (d.y() + shift);
    const double newton = shift + length * length / slope * (length / radius - 1);
    shift = newton > low && newton < high ? newton : 0.5 * (low + high);
  }
  const Vec2 s = step(shift);
  return eigen.vectors * (s.norm() <= radius ? s : step(high));
}

bool is_convex(const GapJet& jet) { return jet.hessian.determinant() > 0 && jet.hessian.trace() > 0; }

/// Decrease of the gap from here to the minimum of a convex model.
double least_of_model(const GapJet& jet) { return 0.5 * jet.gradient.dot(jet.hessian.inverse() * jet.gradient); }

/// Whether a descent from here ends at a known minimum at the way -d: whether the gap between is the cubic that both
/// ends agree on, convex at both. With the mean H of the curvatures there and here, a cubic has the slope H d here;
/// what it rises by is d . (H_there / 3 + H_here / 6) d. Ways and not slopes are compared, so that the flattest
/// direction counts as much as the steepest; as everywhere, the end must be within `same` of the minimum.
bool in_bowl(const GapJet& jet, const Descent& known, const DescentLimits& limits) {
  const SurfacePoint& low = known.minimum.contact.b;
  const Vec3 away = jet.b.p - low.p;
  if (away.squaredNorm() > limits.bowl * limits.bowl || !(jet.b.n.dot(low.n) > 0))
    return false;  // not through a thin body
  const Vec2 d = jet.b.T.transpose() * away;
  const Mat2 turn = jet.b.T.transpose() * low.T, there = turn * known.bend * turn.transpose();
  const double rise = d.dot(there * d) / 3 + d.dot(jet.hessian * d) / 6;
  const Mat2 mean = 0.5 * (there + jet.hessian);
  if (!(rise > 0) || !(there.determinant() > 0) || !(there.trace() > 0) || !(mean.determinant() > 0)) return false;
  return (mean.inverse() * jet.gradient - d).norm() <= std::min(kBowlShare * d.norm(), limits.same) &&
         std::abs(jet.value - known.minimum.gap - rise) <= kBowlShare * rise;
}

bool in_known_bowl(const GapJet& jet, const DescentLimits& limits) {
  return limits.bowl > 0 && is_convex(jet) &&
         std::any_of(limits.known.begin(), limits.known.end(),
                     [&](const Descent& d) { return in_bowl(jet, d, limits); });
}

/// Whether the descent ends at a known minimum, or on a plateau (plane on plane) where every point is a minimum.
bool leads_to_known(const GapJet& jet, const Vec2& step, const DescentLimits& limits) {
  if (limits.known.empty()) return false;
  const bool plateau = jet.gradient.norm() <= 1e-12 && jet.hessian.norm() * limits.same <= 1e-9;
  if (plateau) {
    return std::any_of(limits.known.begin(), limits.known.end(),
                       [&](const Descent& d) { return std::abs(d.minimum.gap - jet.value) <= 1e-9 * limits.same; });
  }
  if (!is_convex(jet) || step.norm() > limits.same) return false;
  const Vec3 end = jet.b.p + jet.b.T * step;
  return std::any_of(limits.known.begin(), limits.known.end(), [&](const Descent& d) {
    return (d.minimum.contact.b.p - end).squaredNorm() < limits.same * limits.same;
  });
}

}  // namespace

bool closest_point(const Surface& surface, const Vec3& x, SurfacePoint& foot) {
  // The offset (I - gap S) is singular at a focal point; from a nearby foot Newton's method needs a few steps only.
  for (int i = 0; i < kMaxFootSteps; ++i) {
    const Vec2 offset = foot.T.transpose() * (x - foot.p);
    const double height = foot.n.dot(x - foot.p);
    if (offset.norm() <= 1e-14 * (1e-3 + std::abs(height))) return true;
    const Mat2 metric = Mat2::Identity() - height * foot.S;
    // Beyond a focal point the foot is no minimum of the distance; the plain offset still descends.
    Vec2 step = metric.determinant() > 0.1 && metric.trace() > 0 ? Vec2(metric.inverse() * offset) : offset;
    SurfacePoint next;
    if (!surface.retract(foot, step, next)) return false;
    foot = next;
    if (step.norm() <= 1e-15) return true;
  }
  return true;
}

std::optional<Descent> descend_gap(const Surface& A, const Surface& B, const Pose& X_ab, const Vec3& start,
                                   const DescentLimits& limits, const KnownStart& known) {
  GapJet jet;
  if (known.on_b != nullptr)
    jet.b = *known.on_b;
  else if (!B.project(start, jet.b))
    return std::nullopt;
  if (!evaluate_gap(A, X_ab, known.foot, jet)) return std::nullopt;
  double radius = limits.max_step;
  bool settled = false;
  const Vec3 from = jet.b.p;
  for (int i = 0; i < kMaxDescentSteps && radius > kShortestDescent; ++i) {
    if (in_known_bowl(jet, limits)) return std::nullopt;  // most starts end here
    const bool flat = jet.gradient.norm() <= kFlatGradient;
    const auto off_saddle = flat ? way_off_a_saddle(jet, radius) : std::nullopt;
    if (flat && !off_saddle) {
      if (leads_to_known(jet, Vec2::Zero(), limits)) return std::nullopt;
      settled = true;
      break;
    }
    const Vec2 step = off_saddle ? *off_saddle : trust_step(jet, radius);
    const double predicted = jet.gradient.dot(step) + 0.5 * step.dot(jet.hessian * step);
    if (i == 0 && is_convex(jet) && jet.value - least_of_model(jet) > limits.hopeless) return std::nullopt;
    if (leads_to_known(jet, step, limits)) return std::nullopt;
    GapJet next;
    const bool arrived = B.retract(jet.b, step, next.b) && evaluate_gap(A, X_ab, nullptr, next);
    // Near the minimum, rounding hides the decrease of the gap long before the gradient vanishes: accept a smaller
    // gradient.
    const double rounding = 1e-15 * (1 + std::abs(jet.value) + jet.b.p.norm());
    const bool lower = arrived && (jet.value - next.value >= -0.1 * predicted ||
                                   (std::abs(predicted) < 10 * rounding && next.gradient.norm() < jet.gradient.norm()));
    if (!lower) {
      radius = 0.25 * std::min(radius, step.norm());
      settled = arrived && std::abs(predicted) < 10 * rounding;
      if (settled) break;
      continue;
    }
    if (step.norm() > 0.9 * radius) radius = std::min(2 * radius, limits.max_step);
    jet = next;
    if ((jet.b.p - from).squaredNorm() > limits.farthest * limits.farthest) return std::nullopt;
    settled = jet.gradient.norm() <= 1e-9;
  }
  return Descent{{{jet.a, jet.b}, jet.value}, settled, 0.5 * (jet.hessian + jet.hessian.transpose())};
}

}  // namespace genu
