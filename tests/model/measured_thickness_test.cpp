// What is said about a thickness that was measured: where, how often, how badly; once for a surface.
#include "genu/model/measured_thickness.h"

#include <gtest/gtest.h>

#include "support/layers.h"

namespace genu {
namespace {

PlacedScene scene_with_bone() {
  PlacedScene scene;
  scene.bodies.resize(1);
  scene.origins = {Vec3(0, 0, 1)};  // m: reported places are in the frame of the file
  scene.surfaces.resize(1);
  scene.surfaces[0].name = "tibia";
  scene.surfaces[0].body = 0;
  scene.surfaces[0].thickness = SurfaceDef::Thickness{};
  scene.surfaces[0].thickness->measured = true;
  return scene;
}

Bones bone(double depth, double half) {
  Mesh mesh = test::sheet(half, 5);
  for (Vec3& v : mesh.vertices) v[2] -= depth + 0.1 * v[0];
  BoneUnder under;
  under.triangles = std::make_shared<const TriangleTree>(mesh);
  return {std::make_shared<const BoneUnder>(under)};
}

TEST(MeasuredThickness, SilentWhereAllIsWell) {
  Diagnostics out;
  std::shared_ptr<const ThicknessField> field;
  EXPECT_TRUE(thickness_on(scene_with_bone(), bone(3e-3, 12e-3), 0, test::sheet(10e-3, 10), field, out));
  EXPECT_TRUE(field);
  EXPECT_TRUE(out.items().empty());
}

TEST(MeasuredThickness, NothingToMeasure) {
  Diagnostics out;
  std::shared_ptr<const ThicknessField> field;
  PlacedScene scene = scene_with_bone();
  scene.surfaces[0].thickness->measured = false;
  EXPECT_TRUE(thickness_on(scene, {}, 0, test::sheet(10e-3, 10), field, out));
  EXPECT_FALSE(field);
}

TEST(MeasuredThickness, MissingBoneAndBoneThatStandsOut) {
  Diagnostics out;
  const Mesh mesh = test::sheet(10e-3, 10);
  for (int twice = 0; twice < 2; ++twice) {
    std::shared_ptr<const ThicknessField> field;
    EXPECT_TRUE(thickness_on(scene_with_bone(), bone(0.5e-3, 8.1e-3), 0, mesh, field, out));
    ASSERT_EQ(out.items().size(), 2u);
  }
  const std::string missing = out.items()[0].rule, thin = out.items()[1].rule;
  EXPECT_EQ(out.items()[0].severity, Diagnostic::Severity::warning);
  EXPECT_EQ(out.items()[0].key, "surface.tibia.thickness");
  EXPECT_NE(missing.find("no bone within 10 mm under 40 of 121 vertices (33.1 %)"), std::string::npos) << missing;
  EXPECT_NE(missing.find("up to 4.0 mm away at (10.0, -10.0, 1000.0) mm"), std::string::npos) << missing;
  EXPECT_NE(thin.find("thinner than 0.5 mm at 36 of 121 vertices (29.8 %)"), std::string::npos) << thin;
  EXPECT_NE(thin.find("bone stands out by 0.30 mm at (-8.0, "), std::string::npos) << thin;
  EXPECT_EQ(thin.find("outward side"), std::string::npos) << thin;
}

TEST(MeasuredThickness, BoneOutsideNearlyEverywhereAsksForTheOutwardSide) {
  Diagnostics out;
  std::shared_ptr<const ThicknessField> field;
  EXPECT_TRUE(thickness_on(scene_with_bone(), bone(-2e-3, 12e-3), 0, test::sheet(10e-3, 10), field, out));
  ASSERT_EQ(out.items().size(), 1u);
  EXPECT_NE(out.items()[0].rule.find("does its outward side face away from the bone (`inside`)"), std::string::npos)
      << out.items()[0].rule;
}

TEST(MeasuredThickness, NoBoneIsRefused) {
  Diagnostics out;
  std::shared_ptr<const ThicknessField> field;
  EXPECT_FALSE(thickness_on(scene_with_bone(), bone(30e-3, 12e-3), 0, test::sheet(10e-3, 10), field, out));
  ASSERT_EQ(out.items().size(), 1u);
  EXPECT_TRUE(out.has_errors());
  EXPECT_NE(out.items()[0].rule.find("no bone lies within 10 mm"), std::string::npos) << out.items()[0].rule;
}

}  // namespace
}  // namespace genu
