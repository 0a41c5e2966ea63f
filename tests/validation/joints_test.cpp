// Joints other than the knee (meshes/joints): the expected results in the first lines of each scene.
#include <cmath>

#include <gtest/gtest.h>

#include "support/knee_scene.h"
#include "support/scenes.h"

namespace genu::test {
namespace {

ResultTable joint(const std::string& name) {
  return table_of(read_text(source_folder() + "/meshes/joints/" + name + ".toml"));
}

Vec3 vector(const ResultTable& t, std::size_t row, const std::string& stem) {
  return {t.number(row, stem + ".x_mm"), t.number(row, stem + ".y_mm"), t.number(row, stem + ".z_mm")};
}

TEST(Joints, AHipCarriesItsLoadThroughTheCentreOfTheHead) {
  const ResultTable t = joint("hip");
  ASSERT_EQ(t.rows(), 61u);
  double turned = 0;
  Vec3 first = Vec3::Zero();
  for (std::size_t row = 0; row < t.rows(); ++row) {
    const Vec3 load(t.number(row, "forward.scale"), t.number(row, "upward.scale"), -t.number(row, "inward.scale"));
    EXPECT_NEAR(t.number(row, "hip.force_N"), load.norm(), 1e-8 * load.norm()) << row;
    const Vec3 centre = vector(t, row, "hip"), contact = vector(t, row, "hip.cup");
    EXPECT_NEAR(centre.norm(), 0.1, 1e-9) << row;
    EXPECT_LT((centre.normalized() - load.normalized()).norm(), 1e-8) << row;
    EXPECT_LT((contact.normalized() - load.normalized()).norm(), 1e-8) << row;
    if (row == 0) first = load.normalized();
    turned = std::max(turned, std::acos(std::min(1.0, first.dot(load.normalized()))));
  }
  EXPECT_GT(turned, 5 * M_PI / 180);
}

TEST(Joints, AFingerIsHeldByItsTendon) {
  const ResultTable t = joint("finger");
  ASSERT_EQ(t.rows(), 35u);
  for (std::size_t row = 0; row < t.rows(); ++row) {
    EXPECT_NEAR(t.number(row, "left.force_N"), t.number(row, "right.force_N"), 1e-8) << row;
    EXPECT_NEAR(t.number(row, "pip.z_mm"), 0, 1e-9) << row;
    EXPECT_NEAR(t.number(row, "collateral_left.force_N"), t.number(row, "collateral_right.force_N"), 1e-8) << row;
    EXPECT_GT(t.number(row, "tendon.factor"), 20) << row << ": newtons, for 10 at the tip";
    if (row > 0) {
      EXPECT_LT(t.number(row, "tendon.factor"), t.number(row - 1, "tendon.factor")) << row;
    }
  }
}

TEST(Joints, AJawOpensStraightAndGlidesForwardAndDown) {
  const ResultTable t = joint("jaw");
  ASSERT_EQ(t.rows(), 26u);
  for (std::size_t row = 0; row < t.rows(); ++row) {
    EXPECT_NEAR(t.number(row, "left.force_N"), t.number(row, "right.force_N"), 1e-7) << row;
    for (const char* name : {"jaw.roll_deg", "jaw.yaw_deg", "jaw.z_mm"})
      EXPECT_NEAR(t.number(row, name), 0, 1e-7) << row;
    if (row == 0) continue;
    EXPECT_GT(t.number(row, "jaw.x_mm"), t.number(row - 1, "jaw.x_mm")) << row;
    EXPECT_LT(t.number(row, "jaw.y_mm"), t.number(row - 1, "jaw.y_mm")) << row;
  }
}

TEST(Joints, AnAnkleIsNearlyAHinge) {
  const ResultTable t = joint("ankle");
  ASSERT_EQ(t.rows(), 41u);
  for (std::size_t row = 0; row < t.rows(); ++row) {
    EXPECT_LT((vector(t, row, "ankle") - vector(t, 20, "ankle")).norm(), 1.5) << row;
    EXPECT_LT(std::abs(t.number(row, "ankle.inversion_deg")), 2) << row;
    EXPECT_GT(t.number(row, "upper.force_N"), 5 * t.number(row, "side.force_N")) << row;
  }
}

}  // namespace
}  // namespace genu::test
