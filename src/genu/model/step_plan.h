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
    double from = 0, to = 0;  ///< rad or m
  };
  struct Factor {
    double from = 1, to = 1;
  };
  std::vector<Prescribed> prescribed;
  std::vector<Factor> factors;  ///< one for each load
  int increments = 1;
  double start_time = 0, end_time = 1;  ///< s
  bool arc_length = false;              ///< t may turn back on the way from 0 to 1

  /// What is asked at t.
  Target target(double t) const;
  /// Its derivative to t.
  Target rate() const;
  /// The largest change of a prescribed angle over the step, rad; 0 without one.
  double angle_range() const;
  /// Neither a prescribed coordinate nor a load changes; time may.
  bool varies_nothing() const;
  /// The prescribed coordinate that varies, if it is the only thing that does; -1 otherwise.
  int only_driven() const;
};

/// The path of a scene. Loads that a step does not name keep the factor 1; each step begins at the time the one before
/// it ends, the first at 0.
std::vector<StepPlan> plan_steps(const SceneTables& scene);

/// The walk from where a joint is, `state` under loads of `factors`, to where `step` begins; the time stands still.
StepPlan approach_to(const StepPlan& step, const JointModel& model, const State& state,
                     const std::vector<double>& factors);

/// What solving leaves of a reaction of the driven coordinate that is 0, and summing layers: their tolerance times the
/// model's force scale, and its length scale for a moment. N or N m.
double reaction_noise(const JointModel& model, const StepPlan& plan, int driven);

/// "largest 0.57 Nm": the reaction of the driven coordinate where it turns; `rate` has the sign it takes beyond. Empty
/// where the reaction is no more than noise.
std::string reaction_words(const JointModel& model, const StepPlan& plan, int driven, double rate, const State& state);

}  // namespace genu
