#include "genu/contact/local_minimum.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "genu/contact/gap_jet.h"
#include "genu/contact/tolerances.h"
#include "genu/core/decompositions.h"

namespace genu {
namespace {

/// The direction in which the gap curves down, scaled to `radius`; empty at a minimum.
std::optional<Vec2> way_off_a_saddle(const GapJet& jet, double radius) {
  const SymmetricEigen<2> eigen = symmetric_eigen(jet.bend());
  if (eigen.values[0] >= -kSaddleCurvature) return std::nullopt;
  return radius * eigen.vectors.col(0);
}

/// Minimiser of the quadratic model within `radius`: Newton's step where the model is convex, else the shifted step,
/// whose length is the radius to within 0.1 %.
Vec2 trust_step(const GapJet& jet, double radius) {
  const SymmetricEigen<2> eigen = symmetric_eigen(jet.bend());
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

/// Zero at a minimum.
Vec2 next_step(const GapJet& jet, double radius) {
  if (jet.gradient.norm() > kFlatGradient) return trust_step(jet, radius);
  return way_off_a_saddle(jet, radius).value_or(Vec2::Zero());
}

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
  return limits.bowl > 0 && jet.is_convex() &&
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
  if (!jet.is_convex() || step.norm() > limits.same) return false;
  const Vec3 end = jet.b.p + jet.b.T * step;
  return std::any_of(limits.known.begin(), limits.known.end(), [&](const Descent& d) {
    return (d.minimum.contact.b.p - end).squaredNorm() < limits.same * limits.same;
  });
}

/// Evaluates the gap on the way of a descent: roughly at first, to rounding from its last steps on.
class GapWalk {
 public:
  GapWalk(const Surface& A, const Surface& B, const Pose& X_ab, double reach)
      : A_(A), B_(B), X_ab_(X_ab), last_(kRoughWay * reach), shallow_(kShallowOverlap * reach) {}

  bool begin(const Vec3& start, const KnownStart& known, GapJet& jet) const {
    if (known.on_b != nullptr)
      jet.b = *known.on_b;
    else if (!B_.project(start, jet.b))
      return false;
    return evaluate_gap_roughly(A_, X_ab_, known.foot, last_, jet);
  }

  bool is_rough() const { return rough_; }

  /// Whether a step (m) as short as this asks for more.
  bool turns_at(double step) const { return rough_ && step <= last_; }

  /// From now on to rounding, beginning at a step from `jet`, or there if a short radius shows that steps were refused.
  /// Not on another face of a thin body, where the gap is another one.
  bool turn(const GapJet& jet, const Vec2& step, double radius, GapJet& next) {
    rough_ = !((radius > last_ && turn_at(jet, step, next)) || turn_at(jet, Vec2::Zero(), next));
    return !rough_;
  }

  bool go(const GapJet& jet, const Vec2& step, GapJet& next) const {
    const SurfacePoint* near = follows(jet) ? &jet.a : nullptr;
    if (!rough_) return B_.retract(jet.b, step, next.b) && evaluate_gap(A_, X_ab_, near, next);
    return B_.retract_roughly(jet.b, step, next.b) &&
           evaluate_gap_roughly(A_, X_ab_, near, kRoughFoot * step.norm(), next);
  }

 private:
  /// Whether to keep to the foot in place of looking for it anew. Deep inside a thin body another one is nearer.
  bool follows(const GapJet& jet) const { return !A_.knows_distance() && jet.value > -shallow_; }

  bool turn_at(const GapJet& jet, const Vec2& step, GapJet& next) const {
    if (!B_.retract(jet.b, step, next.b)) return false;
    for (const SurfacePoint* near : {static_cast<const SurfacePoint*>(nullptr), &jet.a})
      if (evaluate_gap(A_, X_ab_, near, next) && next.value <= jet.value + last_) return true;
    return false;
  }

  const Surface &A_, &B_;
  const Pose& X_ab_;
  double last_, shallow_;  // m
  bool rough_ = true;
};

}  // namespace

std::optional<Descent> descend_gap(const Surface& A, const Surface& B, const Pose& X_ab, const Vec3& start,
                                   const DescentLimits& limits, const KnownStart& known) {
  GapWalk walk(A, B, X_ab, limits.max_step);
  GapJet jet;
  if (!walk.begin(start, known, jet)) return std::nullopt;
  double radius = limits.max_step;
  bool settled = false;
  const Vec3 from = jet.b.p;
  GapJet next;
  for (int i = 0; i < kMaxDescentSteps && radius > kShortestDescent; ++i) {
    if (in_known_bowl(jet, limits)) return std::nullopt;  // most starts end here
    const Vec2 step = next_step(jet, radius);
    const bool ends = step.isZero(0);
    const double predicted = jet.gradient.dot(step) + 0.5 * step.dot(jet.hessian * step);
    if (i == 0 && !ends && jet.is_convex() && jet.value - least_of_model(jet) > limits.hopeless) return std::nullopt;
    if (leads_to_known(jet, step, limits)) return std::nullopt;
    // Near the minimum, rounding hides the decrease of the gap long before the gradient vanishes.
    const double rounding = 1e-15 * (1 + std::abs(jet.value) + jet.b.p.norm());
    const bool hidden = std::abs(predicted) < 10 * rounding;
    if (walk.turns_at(hidden ? 0 : std::min(radius, step.norm()))) {
      settled = false;
      if (!walk.turn(jet, step, radius, next)) break;
      jet = next;
      continue;
    }
    if (ends) {
      settled = true;
      break;
    }
    const bool arrived = walk.go(jet, step, next);
    const bool lower = arrived && (jet.value - next.value >= -0.1 * predicted ||
                                   (hidden && next.gradient.norm() < jet.gradient.norm()));
    if (!lower) {
      radius = 0.25 * std::min(radius, step.norm());
      settled = arrived && hidden;
      if (settled) break;
      continue;
    }
    if (step.norm() > 0.9 * radius) radius = std::min(2 * radius, limits.max_step);
    jet = next;
    if ((jet.b.p - from).squaredNorm() > limits.farthest * limits.farthest) return std::nullopt;
    settled = jet.gradient.norm() <= 1e-9;
  }
  if (walk.is_rough()) {
    settled = false;
    if (!walk.turn(jet, Vec2::Zero(), 0, next)) return std::nullopt;
    jet = next;
  }
  return Descent{{{jet.a, jet.b}, jet.value}, settled, jet.bend()};
}

}  // namespace genu
