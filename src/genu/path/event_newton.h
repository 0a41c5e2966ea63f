// Newton with the path's parameter as one more unknown and the length of a ligament as one more equation: the pose in
// which the ligament is as long as asked for. An iteration costs what one of the pose alone does, and there are about
// as many of them as one pose takes; a search along the path solves a pose for each of its guesses.
#pragma once

#include <memory>

#include "genu/equilibrium/newton.h"
#include "genu/model/step_plan.h"

namespace genu {

class EventNewton {
 public:
  explicit EventNewton(const JointModel& model) : model_(&model), step_(model) {}

  struct Asked {
    int ligament = 0;
    double length = 0;     ///< m
    double rounding = 0;   ///< m: that near is there
    double tolerance = 0;  ///< of t
  };

  /// From a pose near the path and t to the event on it. False where it is not found: both are then of no use.
  /// `layers`: what is known of elastic layers.
  bool solve(const StepPlan& plan, const Asked& asked, const NewtonOptions& options,
             const std::shared_ptr<LayerMemories>& layers, double& t, State& state);

 private:
  bool correct(const StepPlan& plan, const Asked& asked, double t, const State& state, double past);

  const JointModel* model_;
  NewtonStep step_;
  Linearization here_;
  Correction correction_, motion_;
  State trial_;
};

}  // namespace genu
