// A measured knee whose cartilage is as thick as the bones under it say: thicknesses are those of knees, the poses
// balance, and the layer carries more where it is thinner.
#include <algorithm>

#include <gtest/gtest.h>

#include "support/data.h"
#include "support/judged.h"
#include "support/knee_scene.h"
#include "support/scenes.h"

namespace genu {
namespace {

std::string down_to_bone(const std::string& name) {
  return "\nthickness = { bone = \"" + test::data_path("lenhart2015/lenhart2015-R-" + name + "-subchondral-bone.stl") +
         "\", units = \"m\" }";
}

std::string measured(const std::string& quadrature, double to, int increments) {
  std::string text = test::lenhart_scene("-coarse", 0, to, increments);
  for (const std::string name : {"femur", "tibia"}) {
    const std::string file = "ACLC01-R-" + name + "-cart-coarse.stl\"\nunits = \"m\"";
    text = test::replaced(text, file, file + down_to_bone(name));
  }
  return test::replaced(text, "model = \"rigid\"", "model = \"cartilage\"\nmodulus = 5\npoisson = 0.45\n" + quadrature);
}

TEST(MeasuredThickness, KneeOnItsOwnCartilage) {
  GENU_NEEDS_DATA("lenhart2015/lenhart2015-R-femur-subchondral-bone.stl");
  for (const std::string quadrature :
       {"quadrature = \"triangles\"\ncast_from = \"tibia_cartilage\"", "quadrature = \"smooth\"\ntolerance = 1e-2"}) {
    const test::TemporaryFolder folder;
    Diagnostics out;
    const std::string file = folder.write("scene.toml", measured(quadrature, 60, 3));
    const auto prepared = prepare(file, out);
    ASSERT_TRUE(prepared) << test::messages(out);
    const JointModel::Layer& layer = prepared->model.layers[0];
    EXPECT_GE(layer.thinnest, 1e-3);  // 0.5 mm on either side
    EXPECT_GT(layer.thickest, 6e-3);
    EXPECT_LT(layer.thickest, 12e-3);
    EXPECT_EQ(layer.search_depth, layer.thickest);
    // Cartilage reaches beyond both bones, and both bones stand out of it near its rim.
    const auto warned = std::count_if(out.items().begin(), out.items().end(), [](const Diagnostic& d) {
      return d.key == "surface.femur_cartilage.thickness" || d.key == "surface.tibia_cartilage.thickness";
    });
    EXPECT_EQ(warned, 4) << test::messages(out);
    ContactField field(prepared->model);
    const Solution solution = test::judged(*prepared, solve(*prepared, field, {}));
    EXPECT_EQ(solution.summary.poses_solved, 4) << quadrature;
    for (std::size_t row = 0; row < solution.poses.rows(); ++row) {
      const auto of = [&](const std::string& column) { return solution.poses.number(row, "tibiofemoral." + column); };
      // Where it is pressed the two layers together are as thick as knees have them.
      const double thickness = of("max_depth_mm") / of("max_strain");
      std::printf("row %zu: %.0f N, %.1f mm2, %.2f mm deep in about %.1f mm\n", row + 1, of("force_N"), of("area_mm2"),
                  of("max_depth_mm"), thickness);
      EXPECT_GT(thickness, 1.0);
      EXPECT_LT(thickness, 8.0);
      EXPECT_LT(of("max_strain"), 0.6);
    }
  }
}

TEST(MeasuredThickness, BoneInTheWrongUnitIsRefused) {
  GENU_NEEDS_DATA("lenhart2015/lenhart2015-R-femur-subchondral-bone.stl");
  const test::TemporaryFolder folder;
  std::string text = measured("quadrature = \"triangles\"\ncast_from = \"tibia_cartilage\"", 60, 3);
  text = test::replaced(text, "subchondral-bone.stl\", units = \"m\"", "subchondral-bone.stl\", units = \"mm\"");
  Diagnostics out;
  EXPECT_FALSE(prepare(folder.write("scene.toml", text), out));
  for (const std::string key : {"surface.femur_cartilage.thickness.bone", "surface.tibia_cartilage.thickness.bone"})
    EXPECT_NE(test::messages(out).find(key), std::string::npos) << test::messages(out);
  EXPECT_NE(test::messages(out).find("write units = \"m\""), std::string::npos) << test::messages(out);
}

}  // namespace
}  // namespace genu
