#include "genu/motion/equations_of_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include "genu/model/layer_levels.h"
#include "genu/model/ligament_pieces.h"
#include "genu/motion/motion_rates.h"
#include "genu/motion/tolerances.h"

namespace genu {
namespace {

Eigen::Quaterniond quaternion(OdeSystem::Values y, Eigen::Index from) {
  return {y[from], y[from + 1], y[from + 2], y[from + 3]};
}

}  // namespace

EquationsOfMotion::EquationsOfMotion(const JointModel& model, double tolerance)
    : model_(model),
      tolerance_(tolerance),
      energies_(model.layers.empty() ? 2 : 3),
      hinged_(HingedMotion::fits(model) ? std::make_unique<HingedMotion>(model) : nullptr),
      near_(start_state(model)),
      from_(-std::numeric_limits<double>::infinity()),
      to_(std::numeric_limits<double>::infinity()) {
  modes_.assign(model.ligaments.size(), DamperMode::taut);
  damper_count_ = damper_count(model);
  target_.load_factors.assign(model.loads.size(), 1.0);
  for (const auto& drive : model.drives) target_.prescribed.push_back({drive.quantity, 0});
  drive_rate_.resize(static_cast<Eigen::Index>(model.drives.size()));
  drive_acceleration_.resize(drive_rate_.size());
  const double length = model.scales.length;
  metric_.resize(6 * model.moving_count);
  for (int k = 0; k < model.moving_count; ++k) {
    metric_.segment<3>(6 * k).setConstant(length);
    metric_.segment<3>(6 * k + 3).setOnes();
  }
  set_targets(0);
}

void EquationsOfMotion::set_span(double from, double to) {
  from_ = std::nextafter(from, to);
  to_ = std::nextafter(to, from);
}

void EquationsOfMotion::set_targets(double t) {
  target_.time = std::clamp(t, from_, to_);
  for (std::size_t i = 0; i < model_.drives.size(); ++i) {
    const LoadScale::Value value = model_.drives[i].course.evaluate(target_.time);
    target_.prescribed[i].value = value.factor;
    drive_rate_[static_cast<Eigen::Index>(i)] = value.slope;
    drive_acceleration_[static_cast<Eigen::Index>(i)] = value.curvature;
  }
}

Target EquationsOfMotion::target_at(double t) {
  set_targets(t);
  return target_;
}

VecX EquationsOfMotion::pack(const MotionPoint& point) const {
  const int bodies = model_.moving_count;
  VecX y(size());
  y.tail(energies_).head<2>() << point.load_work, point.dissipated;
  if (energies_ > 2) y[y.size() - 1] = point.layer_work;
  if (hinged_) {
    hinged_->pack(point.state, point.twist, y);
    return y;
  }
  for (std::size_t i = 0; i < model_.bodies.size(); ++i) {
    const int k = model_.bodies[i].moving;
    if (k < 0) continue;
    const Eigen::Quaterniond q = Eigen::Quaterniond(point.state.poses[i].R).normalized();
    y.segment<3>(7 * k) = point.state.poses[i].p;
    y.segment<4>(7 * k + 3) << q.w(), q.x(), q.y(), q.z();
  }
  y.segment(7 * bodies, 6 * bodies) = point.twist;
  return y;
}

bool EquationsOfMotion::set_gradient(MotionPoint& point) {
  linearize_constraints(model_, point.state, target_, constraints_);
  const Eigen::Index first = constraints_.constraint.size();
  const auto rows = first + static_cast<Eigen::Index>(point.state.contacts.size());
  gradient_.resize(rows, metric_.size());
  violation_.resize(rows);
  row_scale_.setConstant(rows, 1 / model_.scales.length);
  gradient_.topRows(first) = constraints_.gradient;
  violation_.head(first) = constraints_.constraint;
  for (Eigen::Index m = 0; m < first; ++m)
    if (is_rotation(model_, target_, static_cast<std::size_t>(m))) row_scale_[m] = 1;
  closed_.resize(point.state.contacts.size());
  for (std::size_t i = 0; i < closed_.size(); ++i) {
    const Eigen::Index row = first + static_cast<Eigen::Index>(i);
    if (!evaluate_closed(model_, point.state, point.state.contacts[i], closed_[i])) return false;
    set_row(model_, point.state.contacts[i], closed_[i].gradient, row, gradient_);
    violation_[row] = closed_[i].gap;
  }
  J_ = row_scale_.asDiagonal() * gradient_ * metric_.asDiagonal();
  return true;
}

double EquationsOfMotion::residual() const {
  return row_scale_.size() == 0 ? 0 : row_scale_.cwiseProduct(violation_).cwiseAbs().maxCoeff();
}

/// The minimum-norm twist, in the metric of lengths and angles, that changes the scaled constraints by `rows`.
VecX EquationsOfMotion::metric_step(const VecX& rows) const {
  return metric_.cwiseProduct(J_.transpose() * gram_.solve(rows));
}

bool EquationsOfMotion::project(MotionPoint& point) {
  if (!set_gradient(point)) return false;
  point.drift = point.residual = residual();
  if (row_scale_.size() == 0) return true;
  gram_.compute(J_ * J_.transpose());
  if (gram_.info() != Eigen::Success || !(gram_.rcond() > kDependentConstraints)) return false;
  for (int k = 0; point.residual > kProjectedResidual && k < kMaxProjections; ++k) {
    const VecX step = metric_step(-row_scale_.cwiseProduct(violation_));
    const State before = point.state;
    for (std::size_t i = 0; i < model_.bodies.size(); ++i)
      if (const int b = model_.bodies[i].moving; b >= 0)
        point.state.poses[i] = retract(before.poses[i], Vec6(step.segment<6>(6 * b)));
    update_coordinates(model_, point.state);
    if (!follow_wraps(model_, point.state)) return false;
    const double last = point.residual;
    if (!set_gradient(point)) return false;
    gram_.compute(J_ * J_.transpose());
    point.residual = residual();
    if (point.residual < last) continue;
    if (last > kMaxProjectedResidual) return false;
    point.state = before;  // rounding
    set_gradient(point);
    point.residual = last;
    break;
  }
  return point.residual <= kMaxProjectedResidual;
}

/// The required rate of each constraint.
VecX EquationsOfMotion::asked_rates() const {
  VecX rates = VecX::Zero(row_scale_.size());
  rates.head(drive_rate_.size()) = drive_rate_;
  return rates;
}

void EquationsOfMotion::project_twist(MotionPoint& point) {
  if (row_scale_.size() == 0) return;
  point.twist -= metric_step(row_scale_.cwiseProduct(gradient_ * point.twist - asked_rates()));
}

/// The matrix of masses and constraints, [M J^T; J 0], scaled.
void EquationsOfMotion::set_system(const MotionPoint& point) {
  const Eigen::Index n = metric_.size(), m = row_scale_.size();
  system_.setZero(n + m, n + m);
  mass_ = 0;
  evaluate_effect(model_.meter.get(), Effect::inertia, model_.inertias.size(), [&] { set_masses(point); });
  system_.topLeftCorner(n, n) /= mass_;
  system_.topRightCorner(n, m) = J_.transpose();
  system_.bottomLeftCorner(m, n) = J_;
}

void EquationsOfMotion::set_masses(const MotionPoint& point) {
  for (std::size_t i = 0; i < model_.bodies.size(); ++i) {
    const int k = model_.bodies[i].moving;
    if (k < 0) continue;
    const Inertia& inertia = model_.inertias[at(k)];
    const Vec6 scale = metric_.segment<6>(6 * k);
    system_.block<6, 6>(6 * k, 6 * k) =
        scale.asDiagonal() * mass_matrix(inertia, point.state.poses[i].R) * scale.asDiagonal();
    mass_ = std::max(mass_, inertia.mass * scale[0] * scale[0]);
  }
}

/// All forces on the bodies except constraint forces, with inertial forces.
void EquationsOfMotion::add_forces(const MotionPoint& point) {
  const State& state = point.state;
  linearize_forces(model_, state, target_, forces_, &point.twist);
  wrench_ = forces_.wrench;
  layers_ = forces_.layer_wrench.size() > 0 ? forces_.layer_wrench.dot(point.twist) + forces_.layer_damped : 0;
  dampers_ = 0;
  evaluate_effect(model_.meter.get(), Effect::damping, damper_count_,
                  [&] { dampers_ = add_damping(model_, state, modes_, point.twist, wrench_); });
  if (!model_.layers.empty()) dampers_ += forces_.layer_damped;
  for (std::size_t i = 0; i < model_.bodies.size(); ++i)
    if (const int k = model_.bodies[i].moving; k >= 0)
      wrench_.segment<6>(6 * k) -=
          gyroscopic_wrench(model_.inertias[at(k)], state.poses[i].R, point.twist.segment<3>(6 * k + 3));
}

/// The required acceleration of each constraint: c'' - J' v.
VecX EquationsOfMotion::asked_accelerations(const MotionPoint& point) const {
  VecX out(row_scale_.size());
  const VecX centripetal = centripetal_rates(model_, point.state, target_, point.twist);
  out.head(centripetal.size()) = -centripetal;
  out.head(drive_acceleration_.size()) += drive_acceleration_;
  for (std::size_t i = 0; i < closed_.size(); ++i) {
    const Vec12 twist = twist_at(model_, point.state.contacts[i], point.twist);
    out[centripetal.size() + static_cast<Eigen::Index>(i)] = -twist.dot(closed_[i].curvature * twist);
  }
  return out;
}

bool EquationsOfMotion::accelerate(MotionPoint& point) {
  const Eigen::Index n = metric_.size(), m = row_scale_.size();
  set_system(point);
  add_forces(point);
  VecX right(n + m);
  right.head(n) = metric_.cwiseProduct(wrench_) / mass_;
  right.tail(m) = row_scale_.cwiseProduct(asked_accelerations(point));
  const VecX solved = system_.partialPivLu().solve(right);
  point.acceleration = metric_.cwiseProduct(solved.head(n));
  const VecX multipliers = -mass_ * row_scale_.cwiseProduct(solved.tail(m));
  const std::size_t first = constraint_count(model_, target_);
  point.state.multipliers.assign(multipliers.data(), multipliers.data() + first);
  for (std::size_t i = 0; i < closed_.size(); ++i)
    point.state.contacts[i].force = multipliers[static_cast<Eigen::Index>(first + i)];
  return solved.allFinite();
}

bool EquationsOfMotion::complete(MotionPoint& point) {
  set_targets(point.time);
  point.state.multipliers.assign(constraint_count(model_, target_), 0.0);
  update_coordinates(model_, point.state);
  if (!follow_wraps(model_, point.state)) return false;
  if (!project(point)) return false;
  project_twist(point);
  return accelerate(point);
}

std::optional<EquationsOfMotion::Opening> EquationsOfMotion::opening(const MotionPoint& point,
                                                                     ActiveContact contact) const {
  ClosedContact closed;
  if (!evaluate_closed(model_, point.state, contact, closed)) return std::nullopt;
  const Vec12 twist = twist_at(model_, contact, point.twist), bent = closed.curvature * twist;
  const Vec12 acceleration = twist_at(model_, contact, point.acceleration);
  return Opening{closed.gradient.dot(twist), closed.gradient.dot(acceleration) + twist.dot(bent),
                 closed.gradient.cwiseAbs().dot(twist.cwiseAbs()),
                 closed.gradient.cwiseAbs().dot(acceleration.cwiseAbs()) + twist.cwiseAbs().dot(bent.cwiseAbs())};
}

bool EquationsOfMotion::strike(MotionPoint& point, VecX& impulses) {
  set_targets(point.time);
  point.state.multipliers.assign(constraint_count(model_, target_), 0.0);
  if (!project(point)) return false;
  set_system(point);
  const Eigen::Index n = metric_.size(), m = row_scale_.size();
  VecX right(n + m);
  right.head(n) = system_.topLeftCorner(n, n) * point.twist.cwiseQuotient(metric_);
  right.tail(m) = row_scale_.cwiseProduct(asked_rates());
  const VecX solved = system_.partialPivLu().solve(right);
  if (!solved.allFinite()) return false;
  const VecX before = point.twist;
  point.twist = metric_.cwiseProduct(solved.head(n));
  impulses = -mass_ * row_scale_.cwiseProduct(solved.tail(m));
  const VecX x = before.cwiseQuotient(metric_), z = solved.head(n);
  const double lost = mass_ / 2 * (x - z).dot(system_.topLeftCorner(n, n) * (x + z));
  // A drive's impulse does work at the mean of its rates before and after.
  double by_drives = 0;
  for (Eigen::Index i = 0; i < drive_rate_.size(); ++i)
    by_drives += impulses[i] * gradient_.row(i).dot(before + point.twist) / 2;
  point.load_work += by_drives;
  point.dissipated += lost + by_drives;
  return true;
}

bool EquationsOfMotion::raise_layers(MotionPoint& point) {
  if (model_.layers.empty() || !raise_layer_levels(model_, forces_, point.state)) return false;
  near_.layer_levels = point.state.layer_levels;
  return true;
}

bool EquationsOfMotion::massless(const MotionPoint& point) {
  point_ = point;
  point_.state.contacts.clear();
  if (!complete(point_)) return true;
  return !system_.fullPivLu().isInvertible();
}

/// The poses, twists and accumulated energies in y.
bool EquationsOfMotion::unpack(double t, OdeSystem::Values y, MotionPoint& out) {
  const int bodies = model_.moving_count;
  if (!y.allFinite()) return false;
  out.time = t;
  out.state = near_;
  for (WrapTouch& touch : out.state.wraps) touch.by_length = true;  // the force is continuous where one begins
  out.modes = modes_;
  out.load_work = y[y.size() - energies_];
  out.dissipated = y[y.size() - energies_ + 1];
  out.layer_work = energies_ > 2 ? y[y.size() - 1] : 0;
  if (hinged_) {
    hinged_->place(y, out.state, out.twist);
    return true;
  }
  for (std::size_t i = 0; i < model_.bodies.size(); ++i) {
    const int k = model_.bodies[i].moving;
    if (k < 0) continue;
    const Eigen::Quaterniond q = quaternion(y, 7 * k + 3);
    if (!(q.norm() > 0.5)) return false;
    out.state.poses[i] = {q.normalized().toRotationMatrix(), y.segment<3>(7 * k)};
  }
  out.twist = y.segment(7 * bodies, 6 * bodies);
  return true;
}

bool EquationsOfMotion::read(double t, OdeSystem::Values y, MotionPoint& out) {
  return unpack(t, y, out) && complete(out);
}

bool EquationsOfMotion::see(double t, OdeSystem::Values y, MotionPoint& out) {
  return unpack(t, y, out) && (hinged_ || complete(out));
}

bool EquationsOfMotion::rate(double t, OdeSystem::Values y, Eigen::Ref<VecX> out) {
  if (hinged_) {
    if (!y.allFinite()) return false;
    set_targets(t);
    hinged_->place(y, near_, point_.twist);
    return hinged_->rate(near_, point_.twist, target_, modes_, out);
  }
  if (!read(t, y, point_)) return false;
  const int bodies = model_.moving_count;
  for (int k = 0; k < bodies; ++k) {
    const Vec3 w = point_.twist.segment<3>(6 * k + 3);
    const Eigen::Quaterniond turn = Eigen::Quaterniond(0, w.x(), w.y(), w.z()) * quaternion(y, 7 * k + 3);
    out.segment<3>(7 * k) = point_.twist.segment<3>(6 * k);
    out.segment<4>(7 * k + 3) << turn.w() / 2, turn.x() / 2, turn.y() / 2, turn.z() / 2;
  }
  out.segment(7 * bodies, 6 * bodies) = point_.acceleration;
  double power = load_power(model_, point_.state, target_, point_.twist);
  for (Eigen::Index i = 0; i < drive_rate_.size(); ++i)
    power += point_.state.multipliers[static_cast<std::size_t>(i)] * drive_rate_[i];
  out[out.size() - energies_] = power;
  out[out.size() - energies_ + 1] = dampers_;
  if (energies_ > 2) out[out.size() - 1] = layers_;
  return out.allFinite();
}

void EquationsOfMotion::weights(OdeSystem::Values y, Eigen::Ref<VecX> out) const {
  const int bodies = hinged_ ? 0 : model_.moving_count;
  const double length = model_.scales.length;
  if (hinged_) hinged_->weights(y, tolerance_, kSpeedTime, out);
  for (int k = 0; k < bodies; ++k) {
    const Eigen::Index speeds = 7 * bodies + 6 * k;
    const double place = std::max(tolerance_ * length, kPlaceRounding * y.segment<3>(7 * k).norm());
    out.segment<3>(7 * k).setConstant(1 / place);
    out.segment<4>(7 * k + 3).setConstant(1 / tolerance_);
    out.segment<3>(speeds).setConstant(1 / (tolerance_ * (length / kSpeedTime + y.segment<3>(speeds).norm())));
    out.segment<3>(speeds + 3).setConstant(1 / (tolerance_ * (1 / kSpeedTime + y.segment<3>(speeds + 3).norm())));
  }
  const double energy = length * model_.scales.force;
  for (Eigen::Index i = out.size() - energies_; i < out.size(); ++i)
    out[i] = 1 / (tolerance_ * (energy + std::abs(y[i])));
}

}  // namespace genu
