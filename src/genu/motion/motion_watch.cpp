#include "genu/motion/motion_watch.h"

#include <algorithm>
#include <numbers>

#include "genu/motion/tolerances.h"

namespace genu {
namespace {

/// m: how far the points of a surface lie from its body's origin, at most.
double reach_of(const Surface& surface, double edge) {
  double reach = 0;
  for (const Vec3& v : surface.triangles(edge, Vec3::Zero(), 0).vertices) reach = std::max(reach, v.norm());
  return reach;
}

}  // namespace

MotionWatch::MotionWatch(const JointModel& model, int body_a, int body_b, const Surface& a, const Surface& b)
    : model_(&model), mover_(b.is_unbounded() ? body_a : body_b), seer_(b.is_unbounded() ? body_b : body_a) {
  const double length = model.scales.length;
  const Surface &moving = b.is_unbounded() ? a : b, &other = b.is_unbounded() ? b : a;
  const double size = moving.is_unbounded() ? kUnboundedReach * length : box_diagonal(moving, length);
  reach_ = moving.is_unbounded() ? kUnboundedReach * length : reach_of(moving, length);
  const double smaller = other.is_unbounded() ? size : std::min(size, box_diagonal(other, length));
  unwatched = std::min(kWatchLength * length, kWatchSize * smaller);
}

/// m/s: upper bound for any point of the surface.
double MotionWatch::speed(const MotionPoint& point) const {
  const auto twist = [&](int body) {
    const int moving = model_->bodies[at(body)].moving;
    return moving < 0 ? Vec6(Vec6::Zero()) : Vec6(point.twist.segment<6>(6 * moving));
  };
  const Vec6 own = twist(mover_), seen_from = twist(seer_);
  const Vec3 arm = point.state.poses[at(mover_)].p - point.state.poses[at(seer_)].p;
  const Vec3 carried = seen_from.head<3>() + seen_from.tail<3>().cross(arm);
  return (own.head<3>() - carried).norm() + reach_ * (own.tail<3>() - seen_from.tail<3>()).norm();
}

double MotionWatch::way(const MotionPoint& from, const MotionPoint& to) const {
  const Pose before = from.state.poses[at(seer_)].inverse() * from.state.poses[at(mover_)];
  const Pose after = to.state.poses[at(seer_)].inverse() * to.state.poses[at(mover_)];
  const double chord = (after.R - before.R).norm() / std::numbers::sqrt2;  // 2 sin(angle / 2)
  return std::max((after.p - before.p).norm() + reach_ * chord,
                  0.5 * (speed(from) + speed(to)) * (to.time - from.time));
}

}  // namespace genu
