#include "genu/equilibrium/pose_accuracy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "genu/equilibrium/newton_step.h"
#include "genu/equilibrium/stability.h"
#include "genu/equilibrium/tolerances.h"

namespace genu {
namespace {

double coarser(double residual) { return std::max(1.0, residual / kUsualResidual); }

/// m: rounding error of coordinates at the bodies' distance from the origin.
double rounding_of_coordinates(const JointModel& model) {
  double farthest = 0;
  for (const JointModel::Body& body : model.bodies) farthest = std::max(farthest, body.centre.norm());
  return 8 * std::numeric_limits<double>::epsilon() * farthest;
}

/// N/m
double stiffness_of(const Linearization& at, int body) {
  return at.stiffness.block<3, 3>(6 * body, 6 * body).diagonal().cwiseAbs().maxCoeff();
}

}  // namespace

PoseAccuracy::PoseAccuracy(const JointModel& model, const Target& target, const Linearization& at)
    : length_(kConvergedLength * model.scales.length),
      rounding_(rounding_of_coordinates(model)),
      twist_(VecX::Zero(at.wrench.size())) {
  double unbalanced = 0;  // N
  for (Eigen::Index i = 0; i < at.wrench.size(); ++i)
    unbalanced = std::max(unbalanced, std::abs(at.wrench[i]) / (i % 6 < 3 ? 1 : model.scales.length));
  force_ = 2 * unbalanced + kForceRounding * model.scales.force;
  for (int body = 0; body < model.moving_count; ++body)
    stiffest_of_all_ = std::max(stiffest_of_all_, stiffness_of(at, body));
  for (const auto& bodies : at.contact_bodies) {
    stiffest_.push_back(0);
    for (const int body : bodies)
      if (body >= 0) stiffest_.back() = std::max(stiffest_.back(), stiffness_of(at, body));
  }
  NewtonStep step(model);
  widest_ = widest_reach(model, step.residual(at, target));
  if (!step.factor(at, target) || !step.linear().full_rank()) return;
  Correction left;
  left.resize(model.moving_count, static_cast<int>(at.constraint.size()), static_cast<int>(at.contacts.size()));
  step.solve(at, left);
  known_ = left.twist.allFinite() && left.forces.allFinite() && left.multipliers.allFinite();
  if (!known_) return;
  twist_ = kCorrectionMargin * left.twist;
  multipliers_ = left.multipliers;
  contact_forces_ = left.forces;
}

double PoseAccuracy::least_told(const JointModel& model, double residual) {
  return coarser(residual) * kIdleForce * model.scales.force;
}

NonsmoothReach PoseAccuracy::widest_reach(const JointModel& model, double residual) {
  const double near = coarser(residual) * kNearBreak, little = least_told(model, residual);
  return {.least = near, .most = near, .idle = little, .little = little};
}

NonsmoothReach PoseAccuracy::reach() const {
  NonsmoothReach out = widest_;
  out.least = kConvergedLength;
  out.length = rounding_;
  out.twist = twist_;
  out.idle = force();
  return out;
}

double PoseAccuracy::force() const { return std::min(force_, widest_.little); }

double PoseAccuracy::of_contact(std::size_t c) const {
  return also(known_ ? contact_forces_[static_cast<Eigen::Index>(c)] : widest_.little, stiffest_[c]);
}

double PoseAccuracy::of_multiplier(Eigen::Index i) const {
  return also(known_ ? multipliers_[i] : widest_.little, stiffest_of_all_);
}

double PoseAccuracy::of_rows() const {
  if (!known_) return widest_.most;
  const VecX off = twist_.cwiseQuotient(stability_metric(twist_.size()));
  return std::clamp(off.cwiseAbs().maxCoeff(), kDependentRow, widest_.most);
}

double PoseAccuracy::also(double correction, double stiffest) const {
  return std::min(std::max(force_, kCorrectionMargin * std::abs(correction)) + length_ * stiffest, widest_.little);
}

}  // namespace genu
