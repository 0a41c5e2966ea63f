// Which units of a measured table are those of a column of results.csv.
#include "genu/store/beside_units.h"

#include <gtest/gtest.h>

#include <cmath>

namespace genu {
namespace {

TEST(BesideUnits, Factors) {
  EXPECT_NEAR(*unit_factor("knee.flexion_deg", "rad"), 180 / M_PI, 1e-12);
  EXPECT_NEAR(*unit_factor("knee.x_mm", "cm"), 10, 1e-14);
  EXPECT_NEAR(*unit_factor("time_s", "ms"), 1e-3, 1e-18);
  EXPECT_NEAR(*unit_factor("ACL.force_N", "kN"), 1e3, 1e-12);
  EXPECT_NEAR(*unit_factor("knee.flexion.reaction_Nm", "N mm"), 1e-3, 1e-18);
  EXPECT_NEAR(*unit_factor("stability.min_eigenvalue_Nmm", "Nm"), 1e3, 1e-12);
  EXPECT_NEAR(*unit_factor("tf.max_pressure_MPa", "kPa"), 1e-3, 1e-18);
  EXPECT_NEAR(*unit_factor("tf.area_mm2", "cm\xC2\xB2"), 100, 1e-12);
  EXPECT_NEAR(*unit_factor("tf.area_mm2", "mm^2"), 1, 1e-15);
  EXPECT_NEAR(*unit_factor("energy.stored_J", "mJ"), 1e-3, 1e-18);
  EXPECT_NEAR(*unit_factor("ACL.strain", "%"), 1e-2, 1e-17);
}

TEST(BesideUnits, OfAnotherDimensionOrNone) {
  EXPECT_FALSE(unit_factor("ACL.force_N", "potatoes"));
  EXPECT_FALSE(unit_factor("ACL.force_N", "mm"));
  EXPECT_FALSE(unit_factor("knee.flexion.reaction_Nm", "N"));
  EXPECT_FALSE(unit_factor("tf.max_pressure_MPa", "mPa")) << "milli is no mega";
  EXPECT_FALSE(unit_factor("ACL.strain", "mm"));
  EXPECT_EQ(units_of("knee.flexion_deg"), "deg, rad");
  EXPECT_EQ(units_of("knee.x_mm"), "mm, cm, m");
  EXPECT_EQ(units_of("tf.max_pressure_MPa"), "MPa, kPa, Pa");
}

TEST(BesideUnits, InTheNameOfAColumn) {
  EXPECT_EQ(unit_in_name("pull [kN]", "ACL.force_N"), "kN");
  EXPECT_EQ(unit_in_name("pull_kN", "ACL.force_N"), "kN");
  EXPECT_EQ(unit_in_name("pull (left)", "ACL.force_N"), "");
  EXPECT_EQ(unit_in_name("pull_m", "ACL.force_N"), "") << "a male, perhaps";
  EXPECT_EQ(unit_in_name("turn", "knee.flexion_deg"), "");
}

TEST(BesideUnits, ThatNobodySays) {
  AngleUnit degrees;
  degrees.degrees = true;
  EXPECT_EQ(unit_unsaid("knee.flexion_deg", {}), "rad");
  EXPECT_EQ(unit_unsaid("knee.flexion_deg", degrees), "deg");
  EXPECT_EQ(unit_unsaid("knee.x_mm", degrees), "m");
  EXPECT_EQ(unit_unsaid("ACL.force_N", {}), "N");
  EXPECT_EQ(unit_unsaid("ACL.strain", {}), "1");
}

}  // namespace
}  // namespace genu
