// The reference knee is whole.
#include "genu/atlas/reference_knee.h"

#include <algorithm>

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

/// Cartilage in front of the femur and facing it, six fibres of tendon, the other fibres to the femur, and a quadriceps
/// of 150 N that pulls upward.
TEST(ReferenceKnee, HasAPatella) {
  const ReferencePatella& patella = reference_knee().patella;
  EXPECT_EQ(patella.cartilage.size(), 365u);
  Vec3 middle = Vec3::Zero();
  for (const FacingPoint& p : patella.cartilage) middle += p.at / 365;
  EXPECT_GT(middle.x(), 0.03);
  EXPECT_EQ(std::count_if(patella.fibres.begin(), patella.fibres.end(), [](const auto& f) { return f.to_tibia; }), 6);
  EXPECT_EQ(patella.fibres.size(), 20u);
  double tension = 0;
  for (const QuadricepsCable& cable : patella.quadriceps) {
    tension += cable.tension;
    EXPECT_GT(cable.femur.y(), cable.patella.y() + 0.05);
  }
  EXPECT_NEAR(tension, 150, 1e-9);
}

}  // namespace
}  // namespace genu
