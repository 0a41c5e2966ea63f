#include "genu/results/columns.h"

#include <gtest/gtest.h>

#include "support/scene_model.h"

namespace genu {
namespace {

TEST(Columns, AreNamedAfterTheSceneWithTheirUnits) {
  const PlacedScene scene =
      test::scene_model(test::knee("[combination.both]\nterms = { \"knee.x\" = 1, \"knee.y\" = 2 }\n" +
                                   test::step("prescribe = { \"knee.flexion\" = 0 }")))
          .scene;
  EXPECT_EQ(coordinate_column(scene, {0, 0}), "knee.flexion_deg");
  EXPECT_EQ(coordinate_column(scene, {{0, 3}, 0}), "both_mm");
  EXPECT_EQ(reaction_column(scene, {0, 0}), "knee.flexion.reaction_Nm");
  EXPECT_EQ(reaction_column(scene, {0, 5}), "knee.z.reaction_N");
  EXPECT_EQ(held_column("hip", 1), "hip.reaction.force_y_N");
  EXPECT_EQ(held_column("hip", 5), "hip.reaction.moment_z_Nm");
  EXPECT_EQ(point_column(scene, 1, false, 0), "torus_lateral.x_mm");
  EXPECT_EQ(point_column(scene, 1, true, 2), "plane_lateral.z_mm");
}

TEST(Columns, LoseTheirUnits) {
  EXPECT_EQ(without_unit("knee.flexion_deg"), "knee.flexion");
  EXPECT_EQ(without_unit("knee.flexion.reaction_Nm"), "knee.flexion.reaction");
  EXPECT_EQ(without_unit("medial.force_N"), "medial.force");
  EXPECT_EQ(without_unit("stability.min_eigenvalue_Nmm"), "stability.min_eigenvalue");
  EXPECT_EQ(without_unit("AAC.strain"), "AAC.strain");
  EXPECT_EQ(without_unit("_N"), "_N");
}

}  // namespace
}  // namespace genu
