#include "genu/equilibrium/poses_between.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(PosesBetween, TurnsAndMovesInProportion) {
  State from, to, out;
  from.poses = {Pose(), Pose{exp_rotation(Vec3(0, 0, 0.2)), Vec3(1, 0, 0)}};
  to.poses = {Pose(), Pose{exp_rotation(Vec3(0, 0, 1.0)), Vec3(3, 4, 0)}};
  out = from;
  poses_between(from, to, 0.25, out);
  EXPECT_LT((out.poses[1].R - exp_rotation(Vec3(0, 0, 0.4))).norm(), 1e-15);
  EXPECT_LT((out.poses[1].p - Vec3(1.5, 1, 0)).norm(), 1e-15);
  poses_between(from, to, 1, out);
  EXPECT_LT((out.poses[1].R - to.poses[1].R).norm(), 1e-15);
  EXPECT_LT((out.poses[1].p - to.poses[1].p).norm(), 1e-15);
}

}  // namespace
}  // namespace genu
