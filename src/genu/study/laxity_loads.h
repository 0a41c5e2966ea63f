// The loads of a laxity test, on the tibia of a joint with `grood_suntay`, with clinical signs (model/grood_suntay.h).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/model/grood_suntay.h"

namespace genu {

/// drawer: force at the tibia's origin of `grood_suntay`, along the tibia's anterior axis, positive anterior.
/// varus: moment about the floating axis. rotation: moment about the tibia's long axis, positive internal.
struct LaxityTest {
  enum class Kind { drawer, varus, rotation };
  Kind kind = Kind::drawer;
  double load = 0;  ///< N or N m, of both directions

  bool turns() const { return kind != Kind::drawer; }
  const char* name() const;                    ///< "drawer", "varus-valgus", "rotation"
  std::string direction(bool positive) const;  ///< "anterior", "posterior", ...
  const char* load_unit() const { return turns() ? "Nm" : "N"; }
  const char* unit() const { return turns() ? "deg" : "mm"; }
  double shown() const;                                 ///< mm or deg per SI unit
  double displacement(const KneeMotion& motion) const;  ///< m or rad, of a motion or of its rate
};

inline constexpr std::size_t kLaxityTests = 3;

/// The joint of a scene with its unit loads: 1 N or 1 N m with factor 1.
struct LaxityJoint {
  Prepared prepared;
  int joint = -1;
  std::array<int, kLaxityTests> loads{};  ///< indices, by kind
  int compression = -1;                   ///< 1 N that pushes the tibia against the femur along the tibia's long axis
  double flexion_sign = 1;                ///< of flexion about the joint's first rotation
  /// The varus moment acts about the floating axis; else about the tibia's own anterior axis, where the joint's
  /// rotations are not those of Grood and Suntay.
  bool floating = true;
  std::vector<std::string> freed = {};  ///< coordinates that the scene's last step prescribes and the test does not
};

/// Adds the loads. Refused in `out`: a scene without `grood_suntay` or with two, motion over time, a fixed tibia, a
/// femur that can move, a joint whose first rotation is not about the femur's flexion axis.
[[nodiscard]] std::optional<LaxityJoint> with_laxity_loads(const Prepared& prepared, Diagnostics& out);

/// A part of a test at an angle of flexion (rad): the load of index `load`, or none for -1, from one value to another,
/// N or N m. All other loads are as at the end of the scene's last step; `compression` in N.
StepPlan laxity_step(const LaxityJoint& knee, double compression, double flexion, int load, double from, double to,
                     int increments);

}  // namespace genu
