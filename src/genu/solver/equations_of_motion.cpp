#include "genu/solver/equations_of_motion.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include "genu/model/motion_rates.h"

namespace genu {
namespace {

constexpr double kOnConstraints = 1e-14;  // scaled residual: positions of some lengths' size round to this
constexpr double kLargestResidual = 1e-11;
constexpr int kMostProjections = 8;
constexpr double kRounding = 1e-15;  // of a position: less is not asked for, however small the scale of length
constexpr double kSecond = 1;        // s: speeds below length / kSecond are small

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Eigen::Quaterniond quaternion(OdeSystem::Values y, Eigen::Index from) {
  return {y[from], y[from + 1], y[from + 2], y[from + 3]};
}

}  // namespace

EquationsOfMotion::EquationsOfMotion(const JointModel& model, double tolerance)
    : model_(model), tolerance_(tolerance), near_(start_state(model)) {
  modes_.assign(model.ligaments.size(), DamperMode::taut);
  target_.load_factors.assign(model.loads.size(), 1.0);
  near_.multipliers.assign(model.held.size(), 0.0);
  const double length = model.scales.length;
  metric_.resize(6 * model.moving_count);
  for (int k = 0; k < model.moving_count; ++k) {
    metric_.segment<3>(6 * k).setConstant(length);
    metric_.segment<3>(6 * k + 3).setOnes();
  }
  row_scale_.resize(static_cast<Eigen::Index>(model.held.size()));
  for (std::size_t m = 0; m < model.held.size(); ++m)
    row_scale_[static_cast<Eigen::Index>(m)] = model.held[m].coordinate.index < 3 ? 1 : 1 / length;
}

VecX EquationsOfMotion::pack(const MotionPoint& point) const {
  const int bodies = model_.moving_count;
  VecX y(size());
  for (std::size_t i = 0; i < model_.bodies.size(); ++i) {
    const int k = model_.bodies[i].moving;
    if (k < 0) continue;
    const Eigen::Quaterniond q = Eigen::Quaterniond(point.state.poses[i].R).normalized();
    y.segment<3>(7 * k) = point.state.poses[i].p;
    y.segment<4>(7 * k + 3) << q.w(), q.x(), q.y(), q.z();
  }
  y.segment(7 * bodies, 6 * bodies) = point.twist;
  y.tail<2>() << point.load_work, point.dissipated;
  return y;
}

void EquationsOfMotion::set_gradient(const MotionPoint& point) {
  linearize_constraints(model_, point.state, target_, constraints_);
  J_ = row_scale_.asDiagonal() * constraints_.gradient * metric_.asDiagonal();
}

double EquationsOfMotion::residual() const {
  return row_scale_.size() == 0 ? 0 : row_scale_.cwiseProduct(constraints_.constraint).cwiseAbs().maxCoeff();
}

/// The smallest twist, in the metric of lengths and angles, that changes the scaled constraints by `rows`.
VecX EquationsOfMotion::metric_step(const VecX& rows) const {
  return metric_.cwiseProduct(J_.transpose() * gram_.solve(rows));
}

bool EquationsOfMotion::project(MotionPoint& point) {
  set_gradient(point);
  point.drift = point.residual = residual();
  if (row_scale_.size() == 0) return true;
  gram_.compute(J_ * J_.transpose());
  for (int k = 0; point.residual > kOnConstraints && k < kMostProjections; ++k) {
    const VecX step = metric_step(-row_scale_.cwiseProduct(constraints_.constraint));
    const State before = point.state;
    for (std::size_t i = 0; i < model_.bodies.size(); ++i)
      if (const int b = model_.bodies[i].moving; b >= 0)
        point.state.poses[i] = retract(before.poses[i], Vec6(step.segment<6>(6 * b)));
    update_coordinates(model_, point.state);
    const double last = point.residual;
    set_gradient(point);
    gram_.compute(J_ * J_.transpose());
    point.residual = residual();
    if (point.residual < last) continue;
    if (last > kLargestResidual) return false;
    point.state = before;  // rounding
    set_gradient(point);
    point.residual = last;
    break;
  }
  return point.residual <= kLargestResidual;
}

void EquationsOfMotion::project_twist(MotionPoint& point) {
  if (row_scale_.size() == 0) return;
  const VecX forbidden = row_scale_.cwiseProduct(constraints_.gradient * point.twist);
  point.twist -= metric_step(forbidden);
}

bool EquationsOfMotion::accelerate(MotionPoint& point) {
  const Eigen::Index n = metric_.size(), m = row_scale_.size();
  target_.time = point.time;
  linearize(model_, point.state, target_, forces_);
  wrench_ = forces_.wrench;
  power_ = add_damping(model_, point.state, modes_, point.twist, wrench_);
  system_.setZero(n + m, n + m);
  double mass = 0;
  for (std::size_t i = 0; i < model_.bodies.size(); ++i) {
    const int k = model_.bodies[i].moving;
    if (k < 0) continue;
    const Inertia& inertia = model_.inertias[at(k)];
    const Mat3& R = point.state.poses[i].R;
    const Vec6 scale = metric_.segment<6>(6 * k);
    system_.block<6, 6>(6 * k, 6 * k) = scale.asDiagonal() * mass_matrix(inertia, R) * scale.asDiagonal();
    wrench_.segment<6>(6 * k) -= gyroscopic_wrench(inertia, R, point.twist.segment<3>(6 * k + 3));
    mass = std::max(mass, inertia.mass * scale[0] * scale[0]);
  }
  system_.topLeftCorner(n, n) /= mass;
  system_.topRightCorner(n, m) = J_.transpose();
  system_.bottomLeftCorner(m, n) = J_;
  VecX right(n + m);
  right.head(n) = metric_.cwiseProduct(wrench_) / mass;
  right.tail(m) = -row_scale_.cwiseProduct(centripetal_rates(model_, point.state, point.twist));
  const VecX solved = system_.partialPivLu().solve(right);
  point.acceleration = metric_.cwiseProduct(solved.head(n));
  point.state.multipliers.resize(model_.held.size());
  for (Eigen::Index k = 0; k < m; ++k)
    point.state.multipliers[static_cast<std::size_t>(k)] = -mass * row_scale_[k] * solved[n + k];
  return solved.allFinite();
}

bool EquationsOfMotion::massless(const MotionPoint& point) {
  point_ = point;
  if (!project(point_) || !accelerate(point_)) return true;
  return !system_.fullPivLu().isInvertible();
}

bool EquationsOfMotion::read(double t, OdeSystem::Values y, MotionPoint& out) {
  const int bodies = model_.moving_count;
  if (!y.allFinite()) return false;
  out.time = t;
  out.state = near_;
  out.modes = modes_;
  out.state.multipliers.assign(model_.held.size(), 0.0);
  for (std::size_t i = 0; i < model_.bodies.size(); ++i) {
    const int k = model_.bodies[i].moving;
    if (k < 0) continue;
    const Eigen::Quaterniond q = quaternion(y, 7 * k + 3);
    if (!(q.norm() > 0.5)) return false;
    out.state.poses[i] = {q.normalized().toRotationMatrix(), y.segment<3>(7 * k)};
  }
  out.twist = y.segment(7 * bodies, 6 * bodies);
  out.load_work = y[y.size() - 2];
  out.dissipated = y[y.size() - 1];
  update_coordinates(model_, out.state);
  if (!project(out)) return false;
  project_twist(out);
  return accelerate(out);
}

bool EquationsOfMotion::rate(double t, OdeSystem::Values y, Eigen::Ref<VecX> out) {
  if (!read(t, y, point_)) return false;
  const int bodies = model_.moving_count;
  for (int k = 0; k < bodies; ++k) {
    const Vec3 w = point_.twist.segment<3>(6 * k + 3);
    const Eigen::Quaterniond turn = Eigen::Quaterniond(0, w.x(), w.y(), w.z()) * quaternion(y, 7 * k + 3);
    out.segment<3>(7 * k) = point_.twist.segment<3>(6 * k);
    out.segment<4>(7 * k + 3) << turn.w() / 2, turn.x() / 2, turn.y() / 2, turn.z() / 2;
  }
  out.segment(7 * bodies, 6 * bodies) = point_.acceleration;
  out[out.size() - 2] = load_power(model_, point_.state, target_, point_.twist);
  out[out.size() - 1] = power_;
  return out.allFinite();
}

void EquationsOfMotion::weights(OdeSystem::Values y, Eigen::Ref<VecX> out) const {
  const int bodies = model_.moving_count;
  const double length = model_.scales.length;
  for (int k = 0; k < bodies; ++k) {
    const Eigen::Index speeds = 7 * bodies + 6 * k;
    const double place = std::max(tolerance_ * length, kRounding * y.segment<3>(7 * k).norm());
    out.segment<3>(7 * k).setConstant(1 / place);
    out.segment<4>(7 * k + 3).setConstant(1 / tolerance_);
    out.segment<3>(speeds).setConstant(1 / (tolerance_ * (length / kSecond + y.segment<3>(speeds).norm())));
    out.segment<3>(speeds + 3).setConstant(1 / (tolerance_ * (1 / kSecond + y.segment<3>(speeds + 3).norm())));
  }
  const double energy = length * model_.scales.force;
  for (Eigen::Index i = out.size() - 2; i < out.size(); ++i) out[i] = 1 / (tolerance_ * (energy + std::abs(y[i])));
}

}  // namespace genu
