// Events in motion where laws of ligaments, their dampers, or the springs of joints at limits change their formula.
#pragma once

#include <vector>

#include "genu/motion/equations_of_motion.h"
#include "genu/path/path_options.h"

namespace genu {

class MotionSwitches {
 public:
  explicit MotionSwitches(const JointModel& model);

  /// Number of event functions.
  int count() const { return static_cast<int>(watches_.size() + limits_.size()); }

  /// The event functions: lengths over the length scale, tensions over the force scale, rad. They are shifted slightly
  /// toward their current side, so that rounding does not trigger an event twice.
  void values(const MotionPoint& point, const std::vector<DamperMode>& modes, double* out) const;

  /// Sets every ligament to the piece and mode of its length and speed, and every function to its side.
  void settle(const MotionPoint& point, State& pieces, std::vector<DamperMode>& modes);

  /// Switches the functions that changed sign (+1, -1, else 0: OdeIntegrator::roots) and returns the events.
  std::vector<PathEvent> switch_over(const std::vector<int>& roots, const MotionPoint& point, State& pieces,
                                     std::vector<DamperMode>& modes);

  /// Whether a ligament is off its piece or mode by more than rounding.
  bool astray(const MotionPoint& point, const State& pieces, const std::vector<DamperMode>& modes) const;

 private:
  struct Watch {
    int ligament;
    int law_break;  ///< index in LigamentLaw::breaks(); -1: the tension of law and damper
  };
  struct Limit {
    int joint;
    double angle;  ///< rad
  };
  void choose_sides(const MotionPoint& point, const std::vector<DamperMode>& modes);
  void unshifted(const MotionPoint& point, const std::vector<DamperMode>& modes, double* out) const;

  const JointModel& model_;
  std::vector<Watch> watches_;
  std::vector<Limit> limits_;
  std::vector<double> sides_;  ///< of each function: 1 or -1
};

}  // namespace genu
