#include "genu/equilibrium/descent_seed.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "genu/core/decompositions.h"
#include "genu/equilibrium/stability.h"
#include "genu/equilibrium/tolerances.h"

namespace genu {
namespace {

class DescentStage {
 public:
  DescentStage(const JointModel& model, ContactField& field, const Target& target, double modulus, Stride stride,
               const Cancelled& cancelled)
      : model_(model), field_(field), target_(target), modulus_(modulus), stride_(stride), cancelled_(cancelled) {
    stop_layers_when(cancelled, here_);
    stop_layers_when(cancelled, there_);
  }

  bool run(State& state, SeedReport& report) {
    if (asked_to_stop(cancelled_)) return false;
    evaluate(state, here_);
    const double cap = stride_ == Stride::careful ? kCarefulStride : 1;  // in units of excess()
    const int most = stride_ == Stride::careful ? kMaxCarefulDescents : kMaxDescents;
    double longest = cap;
    for (int i = 0; i < most; ++i) {
      if (asked_to_stop(cancelled_)) return false;
      ++report.iterations;
      report.deepest = deepest_;
      find_step(state);
      if (!std::isfinite(slope_)) return false;
      if (force_ <= kBalancedForce || excess() <= kNewtonStep) return true;
      const double fraction = std::min(1.0, longest / excess());
      if (!retract(model_, state, correction_, fraction, trial_)) return false;
      evaluate(trial_, there_);
      // The force along the step may change sign, as long as the energy decreases overall. From an equilibrium that
      // only the prescribed motion has changed, both the step and its work are rounding.
      const double slope = there_.wrench.dot(down_);
      const double rounding = kWorkRounding * model_.scales.force * model_.scales.length;
      if (std::isfinite(slope) && slope >= -0.5 * slope_ - rounding) {
        std::swap(state, trial_);
        std::swap(here_, there_);
        longest = std::min(cap, 2 * longest);
        continue;
      }
      longest = 0.4 * fraction * excess();
      if (longest < kStuckStep) return force_ <= kNearEnoughForce;
    }
    return force_ <= kNearEnoughForce;
  }

 private:
  void evaluate(const State& state, Linearization& out) {
    linearize(model_, state, target_, out);
    deepest_ = field_.add_foundation(state, modulus_, out);
  }

  /// The descent step from `here_`, and the multipliers that balance the forces along the constraints.
  void find_step(State& state) {
    const double L = model_.scales.length;
    const Eigen::Index n = here_.wrench.size(), m = here_.constraint.size();
    VecX metric(n);
    for (Eigen::Index i = 0; i < n; ++i) metric[i] = i % 6 < 3 ? L : 1.0;
    const MatX stiffness = -(metric.asDiagonal() * here_.stiffness * metric.asDiagonal());
    const VecX force = metric.asDiagonal() * here_.wrench;
    MatX held = here_.gradient * metric.asDiagonal();
    VecX error = here_.constraint, row_length = VecX::Ones(m);
    for (Eigen::Index k = 0; k < m; ++k)
      if (const double norm = held.row(k).norm(); norm > 0) row_length[k] = norm;
    held.array().colwise() /= row_length.array();
    error.array() /= row_length.array();

    correction_.resize(model_.moving_count, static_cast<int>(m), 0);
    correction_.multipliers.setZero();
    VecX motion = VecX::Zero(n);
    MatX free = MatX::Identity(n, n);
    if (m > 0) {
      free = null_space(held, kDependentRow);
      motion = minimum_norm_solution(held, -error);
      const VecX balancing = minimum_norm_solution(held.transpose(), -force);
      // The multipliers take their full value whatever fraction of the step follows: only the curvature of the
      // constraints depends on them.
      for (Eigen::Index k = 0; k < m; ++k) {
        const double more = balancing[k] / row_length[k];
        state.multipliers[static_cast<std::size_t>(k)] += more;
        here_.wrench += more * here_.gradient.row(k).transpose();
      }
    }
    const VecX along = free.transpose() * force;
    force_ = along.size() == 0 ? 0 : along.cwiseAbs().maxCoeff() / (model_.scales.force * L);
    if (m > 0) force_ = std::max(force_, error.cwiseAbs().maxCoeff());
    down_ = VecX::Zero(n);
    if (along.size() > 0) down_ = metric.asDiagonal() * (free * down(free.transpose() * stiffness * free, along));
    correction_.twist = metric.asDiagonal() * motion;
    correction_.twist += down_;
    slope_ = here_.wrench.dot(down_);
  }

  VecX down(const MatX& stiffness, const VecX& force) const {
    if (!stiffness.allFinite()) return VecX::Constant(force.size(), std::numeric_limits<double>::quiet_NaN());
    const auto eigen = symmetric_eigen(MatX(0.5 * (stiffness + stiffness.transpose())));
    const double least = kMinDescentStiffness * model_.scales.force * model_.scales.length;
    const VecX sizes = eigen.values.cwiseAbs().cwiseMax(least);
    return eigen.vectors * (eigen.vectors.transpose() * force).cwiseQuotient(sizes);
  }

  /// The step in units of the longest allowed step.
  double excess() const {
    double out = 1e-300;
    for (Eigen::Index i = 0; i < correction_.twist.size(); i += 6) {
      out = std::max(out, correction_.twist.segment<3>(i).norm() / (kMaxDescentTranslation * model_.scales.size));
      out = std::max(out, correction_.twist.segment<3>(i + 3).norm() / kMaxDescentRotation);
    }
    return out;
  }

  const JointModel& model_;
  ContactField& field_;
  const Target& target_;
  double modulus_;
  Stride stride_;
  const Cancelled& cancelled_;
  Linearization here_, there_;
  Correction correction_;
  VecX down_;  // the descent part of the twist, along free motions
  State trial_;
  double deepest_ = 0, force_ = 0, slope_ = 0;
};

}  // namespace

SeedReport descent_seed(const JointModel& model, ContactField& field, const Target& target, State& state, Stride stride,
                        const Cancelled& cancelled) {
  return stiffen(model, target, state, [&](double modulus, State& stiffer, SeedReport& report) {
    return DescentStage(model, field, target, modulus, stride, cancelled).run(stiffer, report);
  });
}

}  // namespace genu
