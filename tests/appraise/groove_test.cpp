// Where a patella lies across a groove of known shape.
#include <cmath>

#include <gtest/gtest.h>

#include "genu/appraise/groove.h"
#include "genu/core/units.h"

namespace genu {
namespace {

const Vec3 kAnterior(1, 0, 0), kLateral(0, 0, 1);

/// A trochlea round the axis z: its radius is 20 mm at the bottom, at z = `bottom`, and grows by `slope` on both sides
/// to crests 12 mm away, beyond which it falls as steeply, 35 mm to each side of z = 0.
std::vector<Vec3> trochlea(double bottom, double slope) {
  std::vector<Vec3> out;
  for (double z = -0.035; z <= 0.035; z += 0.7e-3)
    for (double angle = -1.2; angle <= 1.2; angle += 0.03) {
      const double away = std::abs(z - bottom), radius = 0.02 + slope * (away < 0.012 ? away : 0.024 - away);
      out.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    }
  return out;
}

/// 30 mm high and 40 mm wide, flat, its middle at the origin.
std::vector<Vec3> plate() {
  std::vector<Vec3> out;
  for (double z = -0.02; z <= 0.0201; z += 1e-3)
    for (double y = -0.015; y <= 0.0151; y += 1e-3) out.push_back({0, y, z});
  return out;
}

Pose flexed(double angle, double shift) {
  const Mat3 R = exp_rotation(Vec3(0, 0, -angle));
  return {R, R * Vec3(0.025, 0, shift)};
}

TEST(Groove, TheOffsetIsTheMiddleFromTheBottomOverTheWidth) {
  for (const double bottom : {0.0, 4e-3, -5e-3})
    for (const double flexion : {0.0, 0.5, 1.0})
      for (const double shift : {0.0, 3e-3, -11e-3}) {
        const auto there = patella_across(trochlea(bottom, 0.4), plate(), flexed(flexion, shift), kLateral, kAnterior);
        ASSERT_TRUE(there.has_value());
        EXPECT_NEAR(there->width, 0.04, 1e-6);
        EXPECT_NEAR(there->middle, shift, 1e-6);
        EXPECT_NEAR(there->groove, bottom, 2e-3);
        EXPECT_NEAR(there->depth, 0.4 * 0.012, 1e-3);
        EXPECT_NEAR(there->offset(), (shift - bottom) / 0.04, 0.05);
      }
}

TEST(Groove, ATiltedPatellaLiesInTheSamePlace) {
  Pose X = flexed(0.5, 4e-3);
  X.R = X.R * exp_rotation(Vec3(0, 0.5, 0));
  const auto there = patella_across(trochlea(0, 0.4), plate(), X, kLateral, kAnterior);
  ASSERT_TRUE(there.has_value());
  EXPECT_NEAR(there->middle, 4e-3, 1e-6);
  EXPECT_NEAR(there->width, 0.04 * std::cos(0.5), 1e-4);
  EXPECT_NEAR(there->groove, 0, 2e-3);
}

TEST(Groove, OfAFlatSurfaceThereIsNone) {
  EXPECT_FALSE(patella_across(trochlea(0, 0), plate(), flexed(0.2, 0), kLateral, kAnterior).has_value());
  EXPECT_FALSE(patella_across({}, plate(), flexed(0.2, 0), kLateral, kAnterior).has_value());
}

TEST(Groove, AboveTheTrochleaTheNearestOneDistalCounts) {
  Pose X = flexed(0, 2e-3);
  X.p.y() = 0.03;
  const auto there = patella_across(trochlea(5e-3, 0.4), plate(), X, kLateral, kAnterior);
  ASSERT_TRUE(there.has_value());
  EXPECT_NEAR(there->groove, 5e-3, 2e-3);
}

/// A notch between two condyles without a surface between.
TEST(Groove, ANotchIsOne) {
  std::vector<Vec3> condyles;
  for (const Vec3& p : trochlea(0, 0.4))
    if (std::abs(p.z()) > 8e-3) condyles.push_back(p);
  const auto there = patella_across(condyles, plate(), flexed(0.2, 0), kLateral, kAnterior);
  ASSERT_TRUE(there.has_value());
  EXPECT_NEAR(there->groove, 0, 2e-3);
}

/// A plane meets the rear of a femur too, which reaches farther to the sides than its front: no crest of a groove.
TEST(Groove, TheRearOfTheFemurIsNoPartOfIt) {
  std::vector<Vec3> femur;
  for (double z = -0.035; z <= 0.035; z += 0.7e-3)
    for (double y = -0.02; y <= 0.02; y += 0.7e-3) {
      femur.push_back({-0.045 + 5 * z * z, y, z});
      if (std::abs(z) < 0.012) femur.push_back({0.02 + 0.3 * z, y, z});  // higher and higher: no groove
    }
  EXPECT_FALSE(patella_across(femur, plate(), flexed(0, 0), kLateral, kAnterior).has_value());
}

}  // namespace
}  // namespace genu
