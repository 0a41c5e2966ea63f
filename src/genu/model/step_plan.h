// One step of the path: prescribed coordinates, load factors and time, which change linearly with a parameter t from 0
// to 1.
#pragma once

#include <string>
#include <vector>

#include "genu/model/state.h"
#include "genu/scene/scene.h"

namespace genu {

struct StepPlan {
  struct Prescribed {
    QuantityRef coordinate;
    double from = 0, to = 0;        ///< rad or m
    std::vector<int> drivers = {};  ///< as in Target
  };
  struct Factor {
    double from = 1, to = 1;
  };
  std::vector<Prescribed> prescribed;
  std::vector<Factor> factors;  ///< one for each load
  int increments = 1;
  double start_time = 0, end_time = 1;  ///< s
  bool arc_length = false;              ///< t may decrease on the way from 0 to 1

  /// The target at t.
  Target target(double t) const;
  /// The derivative of the target to t.
  Target rate() const;
  /// The largest change of a prescribed angle over the step, rad; 0 without one.
  double angle_range() const;
  /// The part of the step over which no prescribed angle changes by more than `angle` (rad); of a step that changes
  /// none an increment.
  double part_within(double angle) const;
  /// Whether prescribed coordinates and loads are constant; time may change.
  bool varies_nothing() const;
  /// The prescribed coordinate that varies and has a reaction, if nothing else does; else -1.
  int only_driven() const;
};

/// The path of a scene. Loads that a step does not name have factor 1. Each step begins at the end time of the one
/// before, the first at 0.
std::vector<StepPlan> plan_steps(const SceneTables& scene);

/// The transition from `state` under loads of `factors` to the start of `step`; time is constant.
StepPlan approach_to(const StepPlan& step, const JointModel& model, const State& state,
                     const std::vector<double>& factors);

/// Numerical noise of the driven coordinate's reaction: tolerance of the solver and of the layers' quadrature times the
/// model's force scale, and times its length scale for a moment. N or N m.
double reaction_noise(const JointModel& model, const StepPlan& plan, int driven);

/// "largest 0.57 Nm": the extremum of the driven coordinate's reaction. `rate`: its sign beyond. Empty where the
/// reaction is within noise.
std::string reaction_words(const JointModel& model, const StepPlan& plan, int driven, double rate, const State& state);

}  // namespace genu
