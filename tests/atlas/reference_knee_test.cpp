// The reference knee is whole.
#include "genu/atlas/reference_knee.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(ReferenceKnee, HasBonesCartilageFibresAndAFlexion) {
  const ReferenceKnee& knee = reference_knee();
  EXPECT_EQ(knee.femur.bone.size(), 1506u);
  EXPECT_EQ(knee.tibia.bone.size(), 3186u);
  EXPECT_EQ(knee.femur.cartilage.size(), 1707u);
  EXPECT_EQ(knee.tibia.cartilage.size(), 513u);
  EXPECT_EQ(knee.fibres.size(), 55u);
  ASSERT_EQ(knee.flexion.size(), 13u);
  EXPECT_NEAR(knee.bone.width, 0.072, 1e-4);
  EXPECT_NEAR(knee.cartilage.width, 0.0658, 1e-4);
  // At 90 deg of flexion the tibia's long axis points backward.
  EXPECT_GT((knee.flexion[9].linear() * Vec3(0, -1, 0)).dot(Vec3(-1, 0, 0)), 0.99);
}

/// In extension fibres strain as published, or less where the published ones wrap round the condyles and these run
/// straight.
TEST(ReferenceKnee, FibresStrainInExtensionAsPublished) {
  for (const ReferenceFibre& f : reference_knee().fibres) {
    const double straight = (reference_knee().flexion[0] * f.tibia - f.femur).norm();
    EXPECT_NEAR(straight / f.slack - 1, f.strain, f.bundle == "pCAP" ? 0.1 : 0.05) << f.name;
  }
}

}  // namespace
}  // namespace genu
