// Motion of a joint over time: integrates the equations of motion from rest or from given speeds. It stops at every
// nonsmooth point of a load or drive in time, and at every event: a ligament becomes slack or taut or its law changes
// formula, a joint reaches its limit, a contact closes or opens.
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
  /// Target error: of lengths over the length scale, in rad, and of speeds over the length scale per second, in rad/s,
  /// or relative, whichever is larger. Steps get kStepShare of it.
  double tolerance = 0;
  std::vector<std::pair<CoordinateRef, double>> start_rates;  ///< rad/s, m/s; others are 0
  bool from_equilibrium = false;  ///< from where it balances at time 0, not from the joints' start
};

struct MotionResult {
  bool complete = false;
  std::string why;  ///< reason for a failure
  OdeCounts counts;
  std::optional<double> stiff_from;  ///< s: time of the change from Adams to BDF
  double worst_residual = 0;         ///< of the constraints over all output points: MotionPoint::residual
  double worst_drift = 0;            ///< largest distance of y from the constraints after any step
};

struct MotionObserver {
  std::function<void(const MotionPoint&)> point;  ///< at 0, every output interval, and the end
  std::function<void(const PathEvent&)> event;    ///< taut, slack, transition; may be empty
  Cancelled cancelled;
};

/// Output times: multiples of the interval, and the duration.
std::vector<double> output_times(const MotionPlan& plan);

/// From the joints' start coordinates. The model must have the inertias of its bodies.
MotionResult follow_motion(const JointModel& model, const MotionPlan& plan, const MotionObserver& observer);

}  // namespace genu
