// Newton's method with the parameter of the path as one more unknown: it converges at limit points, where the parameter
// has an extremum.
//
// Arc length is measured by the motion of the bodies in characteristic lengths and rad, and by the step's parameter t:
//
//   ds^2 = sum (|v| / L)^2 + |w|^2 + dt^2
//
// The corrector stays on the plane through the predicted point normal, in this metric, to the tangent of the path (H.
// B. Keller, Numerical solution of bifurcation and nonlinear eigenvalue problems, 1977).
#pragma once

#include "genu/equilibrium/active_set.h"
#include "genu/model/step_plan.h"

namespace genu {

/// A point of a path and its unit tangent.
struct ArcPoint {
  Balanced pose;
  double t = 0;
  Correction direction;
};

class ArcNewton {
 public:
  ArcNewton(const JointModel& model, const NewtonOptions& options);

  /// The tangent at a solved point, oriented to make an acute angle with `along`. False where it does not exist or is
  /// not unique.
  bool direction(const StepPlan& plan, const State& state, double t, const Correction& along, Correction& out);

  /// The tangent along which t grows; a regular point has one.
  bool forward(const StepPlan& plan, const State& state, double t, Correction& out);

  /// Solves on the plane normal to the tangent at distance `arc` ahead of `from`. `out.direction` is the new tangent,
  /// or the old one where directed() is false.
  NewtonReport solve(const StepPlan& plan, const ArcPoint& from, double arc, ArcPoint& out);

  /// The opposite direction.
  static void reverse(Correction& direction);

  /// Whether the tangent at the end of the last solve is unique; false at a bifurcation.
  bool directed() const { return directed_; }

  /// Distance between the predicted point and the end of the last solve.
  double strayed() const { return strayed_; }

  /// Inner product of two directions.
  double product(const Correction& a, const Correction& b) const;

  /// The linearization at the state whose tangent was computed last.
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
