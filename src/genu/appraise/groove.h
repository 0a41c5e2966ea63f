// Where a patella lies across the groove of a femur, from the contact surfaces of both.
//
// The femur's surface is cut by the plane through the middle of the patella's surface that contains the femur's lateral
// direction and the patella's anterior one. Its height over that plane's lateral axis has two crests with the groove
// between them (in deep flexion: two condyles with the notch between them). The depth of the groove at a place is how
// far the lower one of the highest points on both sides lies above it. Where the cut has no groove of kLeastGroove (the
// patella lies above the trochlea), the next cut distal of it that has one counts, up to kGrooveReach away.
#pragma once

#include <optional>
#include <vector>

#include "genu/core/pose.h"

namespace genu {

/// All along the femur's lateral axis, m.
struct PatellaAcross {
  double middle = 0;  ///< of the patella's surface, half way between its edges
  double width = 0;   ///< of the patella's surface
  double groove = 0;  ///< middle of the part of the groove that is at least half as deep as its deepest place
  double depth = 0;   ///< of the groove (not along the axis)

  /// How far the patella's middle lies lateral of the groove, over its width.
  double offset() const { return (middle - groove) / width; }
};

/// Points on the contact surfaces of femur and patella in their bodies' frames, of the patella in the femur's by
/// `X_FP`. `lateral` (in the femur) and `anterior` (in the patella) are unit vectors. Empty where no groove is found.
std::optional<PatellaAcross> patella_across(const std::vector<Vec3>& femur, const std::vector<Vec3>& patella,
                                            const Pose& X_FP, const Vec3& lateral, const Vec3& anterior);

}  // namespace genu
