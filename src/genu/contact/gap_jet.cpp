#include "genu/contact/gap_jet.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "genu/contact/tolerances.h"

namespace genu {
namespace {

/// One step of Newton's method to the foot of x.
struct FootStep {
  Vec2 offset;  ///< m: of x from the foot's normal
  double height = 0;

  FootStep(const SurfacePoint& foot, const Vec3& x) : offset(foot.T.transpose() * (x - foot.p)) {
    height = foot.n.dot(x - foot.p);
  }
  Vec2 step(const SurfacePoint& foot) const {
    const Mat2 metric = Mat2::Identity() - height * foot.S;
    // Beyond a focal point the foot is no minimum of the distance; the plain offset still descends.
    return metric.determinant() > 0.1 && metric.trace() > 0 ? Vec2(metric.inverse() * offset) : offset;
  }
};

bool nearly_closest_point(const Surface& surface, const Vec3& x, double enough, SurfacePoint& foot) {
  for (int i = 0; i < kMaxFootSteps; ++i) {
    const FootStep to(foot, x);
    if (to.offset.norm() <= enough) return true;
    SurfacePoint next;
    if (!surface.retract_roughly(foot, to.step(foot), next)) return false;
    foot = next;
  }
  return true;
}

bool differentiate(const Pose& X_ab, GapJet& jet) {
  jet.value = jet.a.n.dot(X_ab * jet.b.p - jet.a.p);
  const Mat32 T_b = X_ab.R * jet.b.T;
  const double opposed = jet.a.n.dot(X_ab.R * jet.b.n);
  jet.gradient = T_b.transpose() * jet.a.n;
  // Hessian of the distance to A at height `value` over the foot: -S (I - value S)^-1 (for a sphere 1/(R + value)).
  const Mat2 distance_hessian = -jet.a.S * (Mat2::Identity() - jet.value * jet.a.S).inverse();
  const Mat2 turn = jet.a.T.transpose() * T_b;
  jet.hessian = opposed * jet.b.S + turn.transpose() * distance_hessian * turn;
  return jet.gradient.allFinite() && jet.hessian.allFinite();
}

/// Whether a foot is the closest point by far, so that it can be followed to x: short of focal points, and not round a
/// sharp bend.
bool is_steady(const SurfacePoint& foot, const Vec3& x) {
  const double mean = 0.5 * foot.S.trace();
  const double largest = std::abs(mean) + std::sqrt(std::max(0.0, mean * mean - foot.S.determinant()));
  return (x - foot.p).norm() * largest < kSteadyFoot;
}

bool begin(const Surface& A, const Vec3& x, const SurfacePoint* near, SurfacePoint& foot) {
  if (near == nullptr || !is_steady(*near, x)) return A.project(x, foot);
  foot = *near;
  return true;
}

}  // namespace

bool closest_point(const Surface& surface, const Vec3& x, SurfacePoint& foot) {
  // The offset (I - gap S) is singular at a focal point; from a nearby foot Newton's method needs a few steps only.
  for (int i = 0; i < kMaxFootSteps; ++i) {
    const FootStep to(foot, x);
    if (to.offset.norm() <= 1e-14 * (1e-3 + std::abs(to.height))) return true;
    const Vec2 step = to.step(foot);
    SurfacePoint next;
    if (!surface.retract(foot, step, next)) return false;
    foot = next;
    if (step.norm() <= 1e-15) return true;
  }
  return true;
}

bool evaluate_gap(const Surface& A, const Pose& X_ab, const SurfacePoint* near, GapJet& jet) {
  const Vec3 x = X_ab * jet.b.p;
  return begin(A, x, near, jet.a) && closest_point(A, x, jet.a) && differentiate(X_ab, jet);
}

bool evaluate_gap_roughly(const Surface& A, const Pose& X_ab, const SurfacePoint* near, double enough, GapJet& jet) {
  const Vec3 x = X_ab * jet.b.p;
  return begin(A, x, near, jet.a) && nearly_closest_point(A, x, enough, jet.a) && differentiate(X_ab, jet);
}

}  // namespace genu
