#include "genu/model/ligament_path.h"

#include "genu/model/two_body_scatter.h"

namespace genu {
namespace {

using Point = LigamentPath::Point;

/// Calls f(moving body, wrench of unit tension) for every end of every line with variable length.
template <typename F>
void for_each_pull(const LigamentPath& path, const std::vector<Pose>& poses, double tension, const F& f) {
  TwoBodyWrench pull;
  path.for_each_line([&](const Point& a, const Point& b, const TautLine& line) {
    if (a.moving == b.moving) return;
    line.evaluate_wrench(poses[at(a.body)], poses[at(b.body)], tension, pull);
    if (a.moving >= 0) f(a.moving, pull.on_a);
    if (b.moving >= 0) f(b.moving, pull.on_b);
  });
}

}  // namespace

void LigamentPath::move_with(const std::vector<int>& moving) {
  for (Point& point : points_) point.moving = moving[at(point.body)];
}

double LigamentPath::length(const std::vector<Pose>& poses) const {
  double length = 0;
  for_each_line([&](const Point& a, const Point& b, const TautLine& line) {
    length += line.length(poses[at(a.body)], poses[at(b.body)]);
  });
  return length;
}

double LigamentPath::length_rate(const std::vector<Pose>& poses, const VecX& twist) const {
  double rate = 0;
  for_each_pull(*this, poses, 1, [&](int body, const Vec6& pull) { rate -= pull.dot(twist.segment<6>(6 * body)); });
  return rate;
}

VecX LigamentPath::length_gradient(const std::vector<Pose>& poses, int moving_count) const {
  VecX out = VecX::Zero(6 * moving_count);
  for_each_pull(*this, poses, 1, [&](int body, const Vec6& pull) { out.segment<6>(6 * body) -= pull; });
  return out;
}

void LigamentPath::add_tension(const std::vector<Pose>& poses, double tension, VecX& wrench) const {
  for_each_pull(*this, poses, tension, [&](int body, const Vec6& pull) { wrench.segment<6>(6 * body) += pull; });
}

void LigamentPath::linearize(const std::vector<Pose>& poses, const LawValue& tension, VecX& gradient, VecX& wrench,
                             MatX* stiffness) const {
  TwoBodyWrench pull;
  gradient.setZero(wrench.size());
  for_each_line([&](const Point& a, const Point& b, const TautLine& line) {
    if (a.moving == b.moving) return;  // its length is constant
    const TwoBodyScatter scatter(a.moving, b.moving);
    const Pose &X_WA = poses[at(a.body)], &X_WB = poses[at(b.body)];
    stiffness != nullptr ? line.evaluate(X_WA, X_WB, 1, 0, pull, scatter.which_move())
                         : line.evaluate_wrench(X_WA, X_WB, 1, pull, scatter.which_move());
    scatter.add_wrench(-pull.on_a, -pull.on_b, gradient);
    if (stiffness == nullptr) return;
    pull.stiffness *= tension.force;
    scatter.add_stiffness(pull.stiffness, *stiffness);
  });
  wrench -= tension.force * gradient;
  if (stiffness == nullptr || tension.stiffness == 0) return;
  for (Eigen::Index j = 0; j < stiffness->cols(); ++j)
    if (gradient[j] != 0) stiffness->col(j) -= tension.stiffness * gradient[j] * gradient;
}

}  // namespace genu
