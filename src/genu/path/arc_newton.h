// Newton with the path's parameter as one more unknown: it passes limit points, where the parameter turns back.
//
// Arc length is measured in characteristic lengths and rad of the bodies' motion and in the step's own parameter t:
//   ds^2 = sum (|v| / L)^2 + |w|^2 + dt^2
// The corrector keeps to the plane through the predicted point that is normal, in this metric, to the direction of the
// path (H. B. Keller, Numerical solution of bifurcation and nonlinear eigenvalue problems, 1977).
#pragma once

#include "genu/equilibrium/active_set.h"
#include "genu/model/step_plan.h"

namespace genu {

/// A point of a path and the unit direction in which it leads on.
struct ArcPoint {
  Balanced pose;
  double t = 0;
  Correction direction;
};

class ArcNewton {
 public:
  ArcNewton(const JointModel& model, const NewtonOptions& options);

  /// The direction of the path at a solved point, the one that makes an acute angle with `along`. False where there is
  /// none or more than one.
  bool direction(const StepPlan& plan, const State& state, double t, const Correction& along, Correction& out);

  /// The direction in which t grows; a regular point has one.
  bool forward(const StepPlan& plan, const State& state, double t, Correction& out);

  /// Solves at distance `arc` ahead of `from` on the plane normal to its direction. `out.direction` is the new one, or
  /// the old one where directed() says that there is none.
  NewtonReport solve(const StepPlan& plan, const ArcPoint& from, double arc, ArcPoint& out);

  /// The opposite direction.
  static void reverse(Correction& direction);

  /// Whether one path leads on from where the last solve ended; false at a bifurcation.
  bool directed() const { return directed_; }

  /// How far the last solve ended from where it was predicted.
  double strayed() const { return strayed_; }

  /// Inner product of two directions.
  double product(const Correction& a, const Correction& b) const;

  /// The linearization at the state for which a direction was found last.
  const Linearization& linearization() const { return here_; }

 private:
  void linearize_at(const StepPlan& plan, const State& state, double t);
  bool factor(const StepPlan& plan, const State& state, double t, const Correction& along);
  bool correct(const StepPlan& plan, const Correction& along, ArcPoint& point, NewtonReport& report);

  const JointModel* model_;
  NewtonOptions options_;
  NewtonStep step_;
  Linearization here_;
  Border border_;
  Correction correction_;
  State trial_;
  double strayed_ = 0;
  bool directed_ = true;
};

}  // namespace genu
