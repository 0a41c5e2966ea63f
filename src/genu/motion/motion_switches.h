// When the laws of ligaments and their dampers, and the springs of joints at their limits, go over into another formula
// during a motion.
#pragma once

#include <vector>

#include "genu/motion/equations_of_motion.h"
#include "genu/path/path_options.h"

namespace genu {

class MotionSwitches {
 public:
  explicit MotionSwitches(const JointModel& model);

  /// How many functions of time change their sign where something switches.
  int count() const { return static_cast<int>(watches_.size() + limits_.size()); }

  /// Those functions: lengths over the scale of length, tensions over the scale of force, rad; shifted by a hair toward
  /// the side they are on, so that what has just passed 0 does not pass it again by a rounding.
  void values(const MotionPoint& point, const std::vector<DamperMode>& modes, double* out) const;

  /// Puts every ligament where its length and speed belong, and every function on its side.
  void settle(const MotionPoint& point, State& pieces, std::vector<DamperMode>& modes);

  /// Switches what changed its sign (+1, -1, else 0: OdeIntegrator::roots) and names it.
  std::vector<PathEvent> switch_over(const std::vector<int>& roots, const MotionPoint& point, State& pieces,
                                     std::vector<DamperMode>& modes);

  /// Whether a ligament lies, by more than rounding, where its piece or its mode does not belong.
  bool astray(const MotionPoint& point, const State& pieces, const std::vector<DamperMode>& modes) const;

 private:
  struct Watch {
    int ligament;
    int law_break;  ///< of LigamentLaw::breaks(); -1: the tension of law and damper together
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
