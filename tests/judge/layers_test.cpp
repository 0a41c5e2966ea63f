// Layers between smooth surfaces before the judge: what it accepts, and how wrong a table has to be to be rejected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corrupted.h"
#include "genu/mesh_files/mesh_writer.h"
#include "support/blend_meshes.h"
#include "support/layers.h"
#include "support/places.h"
#include "support/scene_model.h"
#include "support/scenes.h"

namespace genu {
namespace {

using test::Corrupted;
using ::testing::Contains;
using ::testing::IsEmpty;

/// A ball of 20 mm, with edges of 1.3 mm, pressed with 60 N into a plate with edges of 2 mm, at three places.
/// `floor`: keys of the plate's layer; `more`: tables.
Corrupted pressed(const test::TemporaryFolder& folder, const std::string& floor, const std::string& more = "") {
  EXPECT_EQ(write_ply(test::ball(20e-3, 1.3e-3), folder / "ball.ply", 1e-3, ""), "");
  EXPECT_EQ(write_ply(test::sheet(12e-3, 12), folder / "plate.ply", 1e-3, ""), "");
  const auto mesh = [](const std::string& name, const std::string& body) {
    return test::surface(name, body, "mesh", "file = \"" + name + ".ply\"\nunits = \"mm\"");
  };
  return Corrupted::of(
      folder.write("scene.toml", test::bone_on_ground("{ z = 19.5 }") + mesh("ball", "bone") + mesh("plate", "ground") +
                                     test::layer("foot", "ball", "plate", "quadrature = \"" + floor) + more +
                                     test::load("down", "force = [0, 0, -60]") +
                                     test::step("prescribe = { \"j.x\" = [0, 3], \"j.y\" = 0.3, \"j.a\" = 0, "
                                                "\"j.b\" = 0, \"j.c\" = 0 }\nincrements = 2")));
}

TEST(JudgedLayers, CoarseSmoothMeshesAreHeldToATenthOfTheirLoad) {
  const test::TemporaryFolder folder;
  const Corrupted run = pressed(folder, "smooth\"\n");
  EXPECT_THAT(run.rejections(), IsEmpty()) << to_text(run.judge());
  for (const auto& [column, share] : {std::pair("foot.area_mm2", 0.25), {"foot.max_pressure_MPa", 0.25}}) {
    Corrupted changed = run;
    changed.add(1, column, share * changed.number(1, column));
    EXPECT_FALSE(changed.rejections().empty()) << column;
  }
  Corrupted changed = run;
  changed.add(1, "foot.force_z_N", 0.12 * changed.number(1, "foot.force_z_N"));
  EXPECT_THAT(changed.rejections(), Contains("layer forces"));
}

TEST(JudgedLayers, ASurfaceMayBeInLayersOfBothKinds) {
  const test::TemporaryFolder folder;
  const std::string wall =
      test::surface("wall", "ground", "plane", "origin = [0, 0, 0.1]\npatch = { x = [-9, 9], y = [-9, 9] }");
  const Corrupted run = pressed(folder, "triangles\"\ncast_from = \"ball\"\n",
                                wall + test::layer("side", "ball", "wall", "quadrature = \"smooth\""));
  EXPECT_THAT(run.rejections(), IsEmpty()) << to_text(run.judge());
  EXPECT_GT(Corrupted(run).number(1, "foot.points"), 20);
  EXPECT_GT(Corrupted(run).number(1, "side.points"), 20);
}

TEST(JudgedLayers, RegionsThatTheContactReachesAndLeaves) {
  // Contact is about 4.5 mm wide to either side of x = 0, 1.5 and 3.
  for (const std::string border : {"4.4", "4.45", "4.5", "4.6", "4.8", "5.9", "-1.5"}) {
    const test::TemporaryFolder folder;
    const Corrupted run =
        pressed(folder, "smooth\"\nregions = { far = \"x >= " + border + "\", near = \"x < " + border + "\" }\n");
    EXPECT_THAT(run.rejections(), IsEmpty()) << border << '\n' << to_text(run.judge());
  }
}

TEST(JudgedLayers, TheShareOfARegionIsHeldToLessThanARowOfSamples) {
  for (const std::string border : {"-2", "-0.37", "1.6", "2.9"}) {
    const test::TemporaryFolder folder;
    const Corrupted run =
        pressed(folder, "smooth\"\nregions = { far = \"x >= " + border + "\", near = \"x < " + border + "\" }\n");
    EXPECT_THAT(run.rejections(), IsEmpty()) << border << '\n' << to_text(run.judge());
    Corrupted changed = run;
    changed.add(1, "foot.far.force_z_N", 0.3 * changed.number(1, "foot.force_z_N"));
    EXPECT_THAT(changed.rejections(), Contains("layer forces")) << border;
  }
}

TEST(JudgedLayers, RegionsOfClosedForms) {
  // The borders at x (mm) that were once rejected, and strips thinner than a sample.
  for (const std::string regions :
       {"far = \"x >= 0.54\", near = \"x < 0.54\"", "far = \"x >= 0.32\", near = \"x < 0.32\"",
        "strip = \"x >= -2.5 and x < -2.45\"", "strip = \"x >= -2.5 and x < -2.4\", far = \"x >= 0 and x < 0.1\""}) {
    const test::TemporaryFolder folder;
    const std::string plane = "patch = { x = [-9, 9], y = [-9, 9] }";
    const Corrupted run = Corrupted::of(folder.write(
        "scene.toml",
        test::bone_on_ground("{ z = 19.9 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
            test::surface("plate", "ground", "plane", plane) +
            test::layer("foot", "ball", "plate", "quadrature = \"smooth\"\nregions = { " + regions + " }") +
            test::load("down", "force = [0, 0, -60]") +
            test::step("prescribe = { \"j.x\" = [0, 0.5], \"j.y\" = 0, \"j.a\" = 0, \"j.b\" = 0, \"j.c\" = 0 }\n"
                       "increments = 2")));
    EXPECT_THAT(run.rejections(), IsEmpty()) << regions << '\n' << to_text(run.judge());
  }
}

}  // namespace
}  // namespace genu
