// The motion of a knee as clinicians describe it (Grood and Suntay, J. Biomech. Eng. 105 (1983) 136-144).
//
//   e1  the femur's flexion axis, anterior x proximal of the femur: to the right of the body
//   e3  the tibia's long axis, its proximal direction
//   e2  the floating axis e3 x e1 / |e3 x e1|: anterior
// Angles are rotations about these axes; translations are components along them of the vector from the femur's to the
// tibia's origin. Signs depend on the side, so that mirrored right and left knees have the same six numbers. These
// numbers are output only: prescribed and loaded coordinates are the joint's own.
#pragma once

#include <optional>

#include "genu/core/pose.h"
#include "genu/scene/scene.h"

namespace genu {

struct KneeMotion {
  double flexion = 0;            ///< rad, (-pi, pi]: the distal end of the tibia backward
  double adduction = 0;          ///< rad, [-pi/2, pi/2]: the distal end of the tibia toward the midline (varus)
  double external_rotation = 0;  ///< rad, (-pi, pi]: the front of the tibia away from the midline
  double lateral = 0;            ///< m: of the tibia's origin along e1, away from the midline
  double anterior = 0;           ///< m: of the tibia's origin along e2 (drawer)
  double distraction = 0;        ///< m: of the tibia's origin against e3, away from the femur
};

/// For the poses of the two bones' bodies. Empty where the flexion axis is parallel to the tibia (90 deg of adduction)
/// and the floating axis is undefined.
[[nodiscard]] std::optional<KneeMotion> grood_suntay(const GroodSuntayDef& axes, const Pose& X_W_femur,
                                                     const Pose& X_W_tibia);

/// Its rate for the twists [twist of the femur; twist of the tibia], about the origins of the poses.
[[nodiscard]] std::optional<KneeMotion> grood_suntay_rate(const GroodSuntayDef& axes, const Pose& X_W_femur,
                                                          const Pose& X_W_tibia, const Vec12& twists);

}  // namespace genu
