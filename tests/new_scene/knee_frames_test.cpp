#include "genu/new_scene/knee_frames.h"

#include <cmath>

#include <gtest/gtest.h>

namespace genu {
namespace {

KneeLayout along_axes() {
  KneeLayout knee;
  knee.proximal = Vec3::UnitY();
  knee.anterior = Vec3::UnitX();
  knee.right = Vec3::UnitZ();
  return knee;
}

TEST(KneeFrames, OfFilesAreWordsOfAxes) {
  const auto right = frame_words(frames_of_files(along_axes()), false),
             left = frame_words(frames_of_files(along_axes()), true);
  EXPECT_EQ(right.at("femur_proximal"), "\"y\"");
  EXPECT_EQ(right.at("tibia_anterior"), "\"x\"");
  EXPECT_EQ(right.at("flexion_axis"), "-z");
  EXPECT_EQ(right.at("adduction_axis"), "x");
  EXPECT_EQ(right.at("rotation_axis"), "y");
  EXPECT_EQ(left.at("flexion_axis"), "-z");
  EXPECT_EQ(left.at("adduction_axis"), "-x");
  EXPECT_EQ(left.at("rotation_axis"), "-y");
}

TEST(KneeFrames, ThatAKneeCannotHaveAreNotBelieved) {
  KneeFrames frames = frames_of_files(along_axes());
  EXPECT_TRUE(believed(frames));
  for (const auto& [degrees, good] : {std::pair(20.0, true), std::pair(30.0, false)}) {
    const Mat3 turn = Eigen::AngleAxisd(degrees * M_PI / 180, Vec3::UnitZ()).toRotationMatrix();
    frames.tibia_proximal = turn * Vec3::UnitY();
    frames.tibia_anterior = turn * Vec3::UnitX();
    EXPECT_EQ(believed(frames), good) << degrees;
  }
}

TEST(KneeFrames, OfBonesFollowTheirTurn) {
  FittedKnee fitted;
  const double angle = 0.1;
  fitted.femur.turn = Eigen::AngleAxisd(angle, Vec3::UnitX()).toRotationMatrix();
  fitted.tibia.turn = Eigen::AngleAxisd(-angle, Vec3::UnitZ()).toRotationMatrix();
  const KneeFrames frames = frames_of_bones(fitted);
  EXPECT_NEAR(angle_between(frames_of_files(along_axes()), frames), angle, 1e-12);
  const auto words = frame_words(frames, false);
  EXPECT_EQ(words.at("femur_anterior"), "\"x\"");
  EXPECT_EQ(words.at("femur_proximal"), "[0.0000000, 0.9950042, 0.0998334]");
  EXPECT_EQ(words.at("flexion_axis"), "0.0000000 0.0998334 -0.9950042");
  EXPECT_EQ(words.at("rotation_axis"), "0.0998334 0.9950042 0.0000000");
  // The floating axis is perpendicular to both.
  double across[3];
  ASSERT_EQ(std::sscanf(words.at("adduction_axis").c_str(), "%lf %lf %lf", &across[0], &across[1], &across[2]), 3);
  const Vec3 floating(across[0], across[1], across[2]);
  EXPECT_NEAR(floating.norm(), 1, 1e-6);
  EXPECT_NEAR(floating.dot(Vec3(0, 0.0998334, -0.9950042)), 0, 1e-6);
  EXPECT_NEAR(floating.dot(Vec3(0.0998334, 0.9950042, 0)), 0, 1e-6);
}

}  // namespace
}  // namespace genu
