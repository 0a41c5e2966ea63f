// The motion of a joint over time: the equations of motion integrated from rest, or from given speeds, with a stop at
// every kink of a load or drive in time, and at every moment when a ligament becomes slack or taut, its law changes
// formula, a joint meets its limit, or a contact closes or opens.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "genu/motion/equations_of_motion.h"
#include "genu/path/path_options.h"

namespace genu {

struct MotionPlan {
  double duration = 0;         ///< s
  double output_interval = 0;  ///< s
  /// The error that is aimed at: of lengths over the scale of length, in rad, and of speeds over the scale of length a
  /// second, in rad/s or of themselves, whichever is more. Steps are held to kStepShare of it.
  double tolerance = 0;
  std::vector<std::pair<CoordinateRef, double>> start_rates;  ///< rad/s, m/s; others are 0
  bool from_equilibrium = false;  ///< from where it balances at time 0, not from the joints' start
};

struct MotionResult {
  bool complete = false;
  std::string why;  ///< where it is not
  OdeCounts counts;
  std::optional<double> stiff_from;  ///< s: where BDF took over from Adams
  double worst_residual = 0;         ///< of the constraints in all points handed over: MotionPoint::residual
  double worst_drift = 0;            ///< of the integrated numbers from the constraints, after any step
};

struct MotionObserver {
  std::function<void(const MotionPoint&)> point;  ///< at 0, every output interval, and the end
  std::function<void(const PathEvent&)> event;    ///< taut, slack, transition; may be empty
  Cancelled cancelled;
};

/// Times at which a motion is written down: multiples of the interval, and the duration.
std::vector<double> output_times(const MotionPlan& plan);

/// From the joints' start coordinates. The model must have the inertias of its bodies.
MotionResult follow_motion(const JointModel& model, const MotionPlan& plan, const MotionObserver& observer);

}  // namespace genu
