// Bones are read in their own unit and stand where the shape of their surface does.
#include "genu/assemble/read_bones.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "genu/contact/bone_thickness.h"
#include "genu/core/file_list.h"
#include "genu/mesh_files/mesh_writer.h"
#include "support/knee_scene.h"
#include "support/layers.h"
#include "support/scene_model.h"
#include "support/scenes.h"

namespace genu {
namespace {

/// A ball over a plate whose bone lies 3 mm under it, at its far corner (m).
std::string plate(const std::string& bone) {
  return test::bone_on_ground("{ z = 200 }") + test::surface("ball", "bone", "sphere", "radius = 20\nthickness = 0") +
         test::surface(
             "floor", "ground", "plane",
             "origin = [10, 0, 40]\nz_axis = [1, 0, 0]\npatch = { x = [-9, 9], y = [-9, 9] }\nthickness = " + bone) +
         "[contact.foot]\nsurfaces = [\"ball\", \"floor\"]\nmodel = \"cartilage\"\nmodulus = 5\npoisson = 0.4\n" +
         test::step("");
}

Mesh bone_3mm_under() {
  Mesh mesh = test::sheet(10e-3, 6);
  for (Vec3& v : mesh.vertices) v[2] = -3e-3;
  return mesh;
}

TEST(ReadBones, InTheFrameOfTheShapeAndInEitherUnit) {
  const test::TemporaryFolder folder;
  for (const auto& [unit, metres] : {std::pair{"mm", 1e-3}, std::pair{"m", 1.0}}) {
    EXPECT_EQ(write_ply(bone_3mm_under(), folder / "bone.ply", metres, ""), "");
    const std::string bone = std::string("{ bone = \"bone.ply\", units = \"") + unit + "\", minimum = 0.2 }";
    Diagnostics out;
    const auto p = prepare(folder.write("scene.toml", plate(bone)), out);
    ASSERT_TRUE(p) << test::messages(out);
    EXPECT_TRUE(out.items().empty()) << test::messages(out);
    ASSERT_EQ(p->bones.size(), 2u);
    EXPECT_FALSE(p->bones[0]);
    ASSERT_TRUE(p->bones[1]);
    EXPECT_DOUBLE_EQ(p->bones[1]->least, 0.2e-3);
    const Vec3& corner = p->bones[1]->triangles->corners(0)[0];
    EXPECT_NEAR(corner[0] + own_origin(p->model, 0)[0], 7e-3, 1e-7);  // 10 - 3 mm along the plane's normal, x
    EXPECT_NEAR(p->model.layers[0].thinnest, 3e-3, 1e-8);
    EXPECT_NEAR(p->model.layers[0].thickest, 3e-3, 1e-8);
    EXPECT_NEAR(p->model.layers[0].search_depth, 3e-3, 1e-8);
  }
}

TEST(ReadBones, WhatCannotBeReadIsRefusedByItsKey) {
  const test::TemporaryFolder folder;
  folder.write("bone.ply", "ply\n");
  Diagnostics out;
  EXPECT_FALSE(prepare(folder.write("scene.toml", plate("{ bone = \"bone.ply\", units = \"mm\" }")), out));
  EXPECT_NE(test::messages(out).find("surface.floor.thickness.bone"), std::string::npos) << test::messages(out);
}

TEST(ReadBones, ABoneUnderNothingIsRefused) {
  const test::TemporaryFolder folder;
  Mesh mesh = bone_3mm_under();
  for (Vec3& v : mesh.vertices) v[0] += 0.1;
  EXPECT_EQ(write_ply(mesh, folder / "bone.ply", 1e-3, ""), "");
  Diagnostics out;
  EXPECT_FALSE(prepare(folder.write("scene.toml", plate("{ bone = \"bone.ply\", units = \"mm\" }")), out));
  EXPECT_NE(test::messages(out).find("surface.floor.thickness: no bone lies within 10 mm"), std::string::npos)
      << test::messages(out);
}

TEST(ReadBones, AnOutputFolderThatHoldsTheBoneIsRefused) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "bones");
  EXPECT_EQ(write_ply(bone_3mm_under(), folder / "bones/bone.ply", 1e-3, ""), "");
  EXPECT_EQ(write_file_list(folder / "bones", "results"), "");
  Diagnostics out;
  const std::string scene = folder.write("scene.toml", plate("{ bone = \"bones/bone.ply\", units = \"mm\" }"));
  EXPECT_FALSE(prepare_run(scene, folder / "bones", out));
  EXPECT_NE(test::messages(out).find("holds the mesh"), std::string::npos) << test::messages(out);
}

}  // namespace
}  // namespace genu
