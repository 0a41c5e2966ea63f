#include "genu/equilibrium/stiffness_homotopy.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "genu/equilibrium/tolerances.h"
#include "genu/model/ligament_pieces.h"

namespace genu {
namespace {

/// One stage: Levenberg-Marquardt steps on the scaled residual, as damping may be needed while ligaments are slack.
class Stage {
 public:
  Stage(const JointModel& model, ContactField& field, const Target& target, double modulus, const Cancelled& cancelled)
      : model_(model), field_(field), target_(target), modulus_(modulus), cancelled_(cancelled), step_(model) {
    stop_layers_when(cancelled, here_);
    stop_layers_when(cancelled, there_);
  }

  bool run(State& state, SeedReport& report) {
    if (asked_to_stop(cancelled_)) return false;
    evaluate(state, here_);
    double merit = step_.residual(here_, target_);
    double damping = 1e-3;
    for (int i = 0; i < kMaxStageSteps; ++i) {
      if (asked_to_stop(cancelled_)) return false;
      if (merit <= kStageResidual) return true;
      ++report.iterations;
      damped_ = here_;
      add_damping(damping);
      if (!step_.factor(damped_, target_)) return false;
      step_.solve(damped_, correction_);
      if (!retract(model_, state, correction_, admissible(), trial_)) return false;
      const double touching = deepest_;
      evaluate(trial_, there_);
      const double next = step_.residual(there_, target_);
      // A body that nothing holds falls under a constant load: its residual is constant until it lands.
      const bool falling = touching == 0 && deepest_ == 0 && next <= kFallingRatio * merit;
      if (std::isfinite(next) && (next < merit || falling)) {
        std::swap(state, trial_);
        std::swap(here_, there_);
        merit = next;
        damping = std::max(damping / 8, 1e-9);
      } else {
        deepest_ = touching;
        damping *= 6;
        if (damping > 1e6) return merit <= kNearEnoughResidual;
      }
    }
    return merit <= kNearEnoughResidual;
  }

  double deepest() const { return deepest_; }

 private:
  void evaluate(const State& state, Linearization& out) {
    linearize(model_, state, target_, out);
    deepest_ = field_.add_foundation(state, modulus_, out);
  }

  /// Adds a spring of `damping` times the characteristic stiffness to each free motion.
  void add_damping(double damping) {
    const double L = model_.scales.length, F = model_.scales.force;
    for (Eigen::Index i = 0; i < damped_.stiffness.rows(); ++i)
      damped_.stiffness(i, i) -= damping * (i % 6 < 3 ? F / L : F * L) * 100;
  }

  double admissible() const {
    double excess = 1;
    for (Eigen::Index i = 0; i < correction_.twist.size(); i += 6) {
      excess = std::max(excess, correction_.twist.segment<3>(i).norm() / (kMaxStageTranslation * model_.scales.size));
      excess = std::max(excess, correction_.twist.segment<3>(i + 3).norm() / kMaxStageRotation);
    }
    return 1 / excess;
  }

  const JointModel& model_;
  ContactField& field_;
  const Target& target_;
  double modulus_;
  const Cancelled& cancelled_;
  NewtonStep step_;
  Linearization here_, there_, damped_;
  Correction correction_;
  State trial_;
  double deepest_ = 0;
};

}  // namespace

SeedReport stiffen(const JointModel& model, const Target& target, State& state, const SeedStage& stage,
                   double stiffer) {
  SeedReport report;
  state.contacts.clear();
  reset_pieces(model, state);
  for (LigamentPiece& piece : state.pieces) piece.by_length = true;  // a seed may cross any break
  fit_multipliers(model, target, state);
  const double L = model.scales.length;
  double modulus = stiffer * kFirstModulus * model.scales.force / (L * L * L);
  for (int i = 0; i < kMaxStages; ++i, modulus *= kStiffnessRatio) {
    State next = state;
    // A foundation this stiff rests on a few samples only and may not converge. The previous stage is a seed as well.
    if (!stage(modulus, next, report)) {
      if (!report.balanced) report.ended = std::move(next);
      break;
    }
    state = std::move(next);
    report.balanced = true;
    if (report.deepest < kStageOverlap * L) break;
  }
  reset_pieces(model, state);
  return report;
}

SeedReport stiffness_homotopy(const JointModel& model, ContactField& field, const Target& target, State& state,
                              double stiffer, const Cancelled& cancelled) {
  const auto run = [&](double modulus, State& next, SeedReport& report) {
    Stage stage(model, field, target, modulus, cancelled);
    if (!stage.run(next, report)) return false;
    report.deepest = stage.deepest();
    return true;
  };
  return stiffen(model, target, state, run, stiffer);
}

}  // namespace genu
