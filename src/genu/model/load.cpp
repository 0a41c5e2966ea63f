#include "genu/model/load.h"

#include <Eigen/Geometry>

namespace genu {

BodyWrench evaluate_load(const LoadDef& load, const Pose& X_WB, double factor) {
  const bool follower = load.frame == LoadDef::Frame::body;
  const Vec3 r = X_WB.R * load.point;
  const Vec3 force = factor * (follower ? Vec3(X_WB.R * load.force) : load.force);
  const Vec3 moment = factor * (follower ? Vec3(X_WB.R * load.moment) : load.moment);

  BodyWrench out;
  out.wrench << force, moment + r.cross(force);
  if (follower) {  // the whole wrench turns: d = w x
    out.stiffness.block<3, 3>(0, 3) = -skew(force);
    out.stiffness.block<3, 3>(3, 3) = -skew(out.wrench.tail<3>());
  } else {  // the lever arm turns: (w x r) x f
    out.stiffness.block<3, 3>(3, 3) = skew(force) * skew(r);
  }
  return out;
}

}  // namespace genu
