// Drawn bones, moved to where no knee is: each is told, and the knee itself is not doubted.
#include "genu/study/layout_doubts.h"

#include <gtest/gtest.h>

#include "genu/core/diagnostics.h"
#include "genu/core/pose.h"
#include "genu/core/units.h"
#include "genu/mesh_files/mesh_reader.h"
#include "support/data.h"
#include "support/places.h"

namespace genu {
namespace {

class LayoutDoubts : public ::testing::Test {
 protected:
  // x anterior, y superior, z lateral (meshes/leskovar2019/bones.toml).
  static Mesh bone(const char* name) {
    Diagnostics out;
    return read_mesh(genu::test::source_folder() + "/meshes/leskovar2019/" + name, 1e-3, out).value_or(Mesh{});
  }
  const Mesh femur_ = bone("femur.stl"), tibia_ = bone("tibia.stl");

  static std::string told(const Mesh& femur, const Mesh& tibia, const char* proximal, bool impossible) {
    const auto knee = lay_out_knee(femur, tibia, axis_named(proximal), axis_named("x"));
    if (!knee) return "no layout";
    std::string all;
    for (const LayoutDoubt& d : doubts_about(femur, tibia, *knee, 1e-3)) {
      EXPECT_EQ(d.impossible, impossible) << d.what;
      all += d.what;
    }
    return all;
  }

  static Mesh changed(Mesh mesh, const Mat3& by, const Vec3& shift) {
    for (Vec3& p : mesh.vertices) p = by * p + shift;
    return mesh;
  }
};

bool tells(const std::string& text, const char* piece) { return text.find(piece) != std::string::npos; }

TEST_F(LayoutDoubts, AKneeIsNotDoubted) {
  EXPECT_EQ(told(femur_, tibia_, "y", true), "");
  // Nor where it is scanned apart by a little, or with a slope that tibias have.
  EXPECT_EQ(told(changed(femur_, Mat3::Identity(), {0, 0.02, 0}), tibia_, "y", true), "");
  EXPECT_EQ(told(femur_, changed(tibia_, exp_rotation(Vec3(0, 0, 10 * units::kDegree)), Vec3::Zero()), "y", true), "");
}

TEST_F(LayoutDoubts, WhatIsNoKneeIsRefused) {
  const Mat3 same = Mat3::Identity();
  EXPECT_TRUE(tells(told(tibia_, tibia_, "y", true), "same mesh"));
  EXPECT_TRUE(tells(told(tibia_, femur_, "y", true), "swapped"));
  EXPECT_TRUE(tells(told(changed(femur_, same, {0, 0, 0.5}), tibia_, "y", true), "one frame"));
  EXPECT_TRUE(tells(told(changed(femur_, same, {0, 0.3, 0}), tibia_, "y", true), "apart by"));
  EXPECT_TRUE(tells(told(changed(femur_, same, {0, -0.06, 0}), tibia_, "y", true), "into each other"));
  EXPECT_TRUE(tells(told(changed(femur_, 10 * same, Vec3::Zero()), tibia_, "y", true), "one unit"));
}

TEST_F(LayoutDoubts, AFewTrianglesAreWorthALook) {
  Mesh coarse;
  coarse.vertices = {{0, 0, -0.04}, {0.05, 0, 0}, {0, 0, 0.04}, {0.02, 0.01, 0}};
  coarse.triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}};
  EXPECT_TRUE(tells(told(coarse, tibia_, "y", false), "the femur has 4 triangles"));
}

TEST_F(LayoutDoubts, ATibiaTooNarrowForItsUnit) {
  for (const auto& [factor, unit] : {std::pair(0.1, "in cm"), std::pair(1 / 25.4, "in inch"), std::pair(4.0, "unit")}) {
    const Mat3 by = factor * Mat3::Identity();
    const std::string what = told(changed(femur_, by, Vec3::Zero()), changed(tibia_, by, Vec3::Zero()), "y", false);
    EXPECT_NE(what.find(unit), std::string::npos) << what;
  }
}

/// A mirror makes a left knee of a right one. Turned about, a knee stays what it is.
TEST_F(LayoutDoubts, TheSideIsTold) {
  Mat3 mirror = Mat3::Identity();
  mirror(2, 2) = -1;
  const auto layout = [&](const Mat3& by) {
    return lay_out_knee(changed(femur_, by, Vec3::Zero()), changed(tibia_, by, Vec3::Zero()), axis_named("y"),
                        axis_named("x"));
  };
  const auto right = layout(Mat3::Identity()), left = layout(mirror);
  ASSERT_TRUE(right && left);
  EXPECT_EQ(seems_left(*right), std::optional(false)) << why_this_side(*right);
  EXPECT_EQ(seems_left(*left), std::optional(true)) << why_this_side(*left);
  EXPECT_NEAR(left->ridge, -right->ridge, 1e-9);
  EXPECT_NEAR(left->plateau, -right->plateau, 1e-9);
}

TEST_F(LayoutDoubts, TheSideOfMeasuredKnees) {
  GENU_NEEDS_DATA("ssm/mean_Femur.ply");
  Mat3 mirror = Mat3::Identity();
  mirror(0, 0) = -1;
  for (const std::string knee : {"mean", "S001", "S002"})
    for (const std::string kind : {"", "_Cartilage"})
      for (const bool mirrored : {false, true}) {
        const auto bone = [&](const std::string& name) {
          Diagnostics out;
          const std::string end = knee == "mean" && name == "_Tibia" ? "_shifted" : "";
          return read_mesh(test::data_path("ssm/" + knee + name + kind + end + ".ply"), 1e-3, out).value_or(Mesh{});
        };
        const Mat3 by = mirrored ? mirror : Mat3(Mat3::Identity());
        const auto layout =
            lay_out_knee(changed(bone("_Femur"), by, Vec3::Zero()), changed(bone("_Tibia"), by, Vec3::Zero()));
        ASSERT_TRUE(layout);
        EXPECT_EQ(seems_left(*layout), std::optional(mirrored)) << knee << kind << ": " << why_this_side(*layout);
      }
}

}  // namespace
}  // namespace genu
