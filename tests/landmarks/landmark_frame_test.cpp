#include "genu/landmarks/landmark_frame.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(LandmarkFrame, TakesPointsFromOneToAnother) {
  const Vec3 p(1, 2, 3);
  EXPECT_EQ(turn_between("LPS", "RAS") * p, Vec3(-1, -2, 3));
  EXPECT_EQ(turn_between("RAS", "RAS") * p, p);
  EXPECT_EQ(turn_between("RAS", "ASR") * p, Vec3(2, 3, 1));
  EXPECT_EQ(turn_between("RAS", "SPL") * p, Vec3(3, -2, -1));
  EXPECT_EQ(turn_between("SPL", "RAS") * turn_between("RAS", "SPL"), Mat3::Identity());
}

}  // namespace
}  // namespace genu
