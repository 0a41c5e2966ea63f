// 4x4 matrices that are rigid motions, and those that are none.
#include "genu/assemble/rigid_transform.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

Mat4 matrix_of(const Vec3& turn, const Vec3& p) {
  Mat4 m = Mat4::Identity();
  m.topLeftCorner<3, 3>() = exp_rotation(turn);
  m.topRightCorner<3, 1>() = p;
  return m;
}

bool has(const std::string& text, const std::string& piece) { return text.find(piece) != std::string::npos; }

TEST(RigidTransform, APoseAndBack) {
  const Mat4 m = matrix_of({0.3, -0.7, 1.1}, {1, 2, 3});
  EXPECT_EQ(fault_of_transform(m), "");
  EXPECT_LT((pose_of_transform(m).R - exp_rotation({0.3, -0.7, 1.1})).norm(), 1e-15);
  EXPECT_EQ(pose_of_transform(m).p, Vec3(1, 2, 3));
}

TEST(RigidTransform, ThreeDecimalsAreEnough) {
  Mat4 m = matrix_of({0.3, -0.7, 1.1}, {1, 2, 3});
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m(i, j) = std::round(m(i, j) * 1e3) / 1e3;
  EXPECT_EQ(fault_of_transform(m), "");
  const Mat3 R = pose_of_transform(m).R;
  EXPECT_LT((R * R.transpose() - Mat3::Identity()).norm(), 1e-14);
  EXPECT_LT((R - exp_rotation({0.3, -0.7, 1.1})).norm(), 1.5e-3);
}

TEST(RigidTransform, WhatIsNone) {
  const Mat4 good = matrix_of({0.3, -0.7, 1.1}, {10, 20, 30});
  EXPECT_TRUE(has(fault_of_transform(good.transpose()), "written column by column"));
  Mat4 m = good;
  m.row(0) *= 2;
  EXPECT_TRUE(has(fault_of_transform(m), "is no rotation: its rows have the lengths 2, 1, 1")) << fault_of_transform(m);
  m = good;
  m.topLeftCorner<3, 3>().row(2) *= -1;
  EXPECT_TRUE(has(fault_of_transform(m), "mirrors (determinant -1)"));
  m = good;
  m(3, 3) = 0;
  EXPECT_TRUE(has(fault_of_transform(m), "has the last row 0 0 0 0, which must be 0 0 0 1")) << fault_of_transform(m);
}

}  // namespace
}  // namespace genu
