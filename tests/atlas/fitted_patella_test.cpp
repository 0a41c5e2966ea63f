#include "genu/atlas/fitted_patella.h"

#include <gtest/gtest.h>

#include "support/point_mesh.h"

namespace genu {
namespace {

using test::as_mesh;

/// The reference itself, larger, turned, and as its mirror image; the patella lies elsewhere than in the reference.
TEST(FittedPatella, OfItselfIsItself) {
  const ReferenceKnee& knee = reference_knee();
  for (const double side : {1.0, -1.0}) {
    const double scale = 1.1;
    const Affine map{
        scale * Eigen::AngleAxisd(0.5, Vec3(1, 0, 1).normalized()).toRotationMatrix() * Vec3(1, 1, side).asDiagonal(),
        Vec3(0.2, 0.1, -0.3)};
    const Affine aside{map.linear * Eigen::AngleAxisd(0.15, Vec3::UnitY()).toRotationMatrix(),
                       map.shift + Vec3(0.004, 0.002, 0.01)};
    const Mesh femur = as_mesh(knee.femur.bone, map), tibia = as_mesh(knee.tibia.bone, map),
               patella = as_mesh(knee.patella.cartilage, aside);
    const FittedKnee fitted =
        fit_reference_knee(femur, tibia,
                           {map.linear.col(0) / scale, map.linear.col(1) / scale, map.linear.col(2) / scale,
                            map(knee.bone.centre), scale * knee.bone.width, 0});
    const FittedPatella found = fit_reference_patella({patella, patella, femur, tibia}, fitted);
    EXPECT_FALSE(found.poor());
    EXPECT_LT(found.median, 1e-4);
    ASSERT_EQ(found.fibres.size(), knee.patella.fibres.size());
    for (std::size_t i = 0; i < found.fibres.size(); ++i) {
      const PatellaFibre& fibre = knee.patella.fibres[i];
      EXPECT_LT((found.fibres[i].patella.at - aside(fibre.patella)).norm(), 5e-4) << fibre.name;
      EXPECT_LT((found.fibres[i].bone.at - map(fibre.bone)).norm(), 9e-3) << fibre.name;  // put onto the bone
      EXPECT_GT(found.fibres[i].bone.error, 2e-3);
    }
    ASSERT_EQ(found.quadriceps.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      const QuadricepsCable& cable = knee.patella.quadriceps[i];
      EXPECT_NEAR(found.quadriceps[i].radius, scale * cable.radius, 1e-3);
      EXPECT_LT((found.quadriceps[i].patella - aside(cable.patella)).norm(), 5e-4) << cable.name;
      EXPECT_LT((found.quadriceps[i].centre - map(cable.centre)).norm(), 2e-3) << cable.name;
      EXPECT_GT(found.quadriceps[i].anterior.dot(map.linear.col(0)) / scale, 0.99);
    }
  }
}

/// What rises and falls by 5 mm from point to point is none.
TEST(FittedPatella, OfARoughMeshIsPoor) {
  const ReferenceKnee& knee = reference_knee();
  std::vector<FacingPoint> plate;
  for (int i = 0; i < 30; ++i)
    for (int k = 0; k < 30; ++k)
      plate.push_back({Vec3(0.045 + 0.005 * ((i + k) % 3 - 1), 0.0015 * i - 0.02, 0.0015 * k - 0.02), -Vec3::UnitX()});
  const Affine same;
  const Mesh femur = as_mesh(knee.femur.bone, same), tibia = as_mesh(knee.tibia.bone, same),
             mesh = as_mesh(plate, same);
  const FittedKnee fitted = fit_reference_knee(
      femur, tibia, {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), knee.bone.centre, knee.bone.width, 0});
  EXPECT_TRUE(fit_reference_patella({mesh, mesh, femur, tibia}, fitted).poor());
}

}  // namespace
}  // namespace genu
