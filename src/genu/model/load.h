// An external force and moment on a body, constant in the world or following the body.
#pragma once

#include "genu/core/pose.h"
#include "genu/core/types.h"
#include "genu/scene/scene.h"

namespace genu {

/// [force, moment about the body's own origin] in world axes (N, N m) and its derivative to the body's twist [v, w].
struct BodyWrench {
  Vec6 wrench = Vec6::Zero();
  Mat6 stiffness = Mat6::Zero();  ///< d wrench / d twist; in general unsymmetric, and nothing depends on v
};

/// The wrench of `load` times `factor` on its body, whose pose in the world is X_WB.
/// LoadDef::Frame::world keeps force and moment constant in the world, only the point moves with the body; body turns
/// force and moment with the body (a follower load, which has no potential).
BodyWrench evaluate_load(const LoadDef& load, const Pose& X_WB, double factor);

}  // namespace genu
