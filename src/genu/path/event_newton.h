// Newton's method with the parameter of the path as one more unknown and the length of a ligament as one more equation:
// finds the pose at which the ligament has a given length. It takes about as many iterations as one pose, of the same
// cost. A search along the path would solve one pose per guess.
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
    double rounding = 0;   ///< m: a length this close is accepted
    double tolerance = 0;  ///< of t
  };

  /// From a pose near the path at `t` to the event. False where it is not found; state and t are then meaningless.
  /// `layers`: memory of the elastic layers.
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
