// Meshes are made by their recipes, the same bytes every time.
#include "hard_cases/hard_case_mesh.h"

#include <string>

#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_reader.h"
#include "genu/scene/reader.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

Scene shapes(const test::TemporaryFolder& folder) {
  Diagnostics out;
  const auto scene = read_surface_file(
      folder.write("shapes.toml",
                   "format = 1\nunits = { length = \"mm\", angle = \"deg\" }\n[surface.ball]\nbody = \"b\"\nshape = "
                   "\"sphere\"\nradius = 20\n[solid.slab]\nparts = [{ shape = \"box\", size = [20, 20, 4] }]\n"),
      out);
  EXPECT_TRUE(scene);
  return scene.value_or(Scene{});
}

TEST(HardCaseMesh, SubdividedShapesStayOnTheirSurface) {
  const test::TemporaryFolder folder;
  MeshRecipe recipe;
  recipe.file = "ball.ply";
  recipe.shape = "ball";
  recipe.edge = 6e-3;
  MeshRecipe::Damage twice;
  twice.kind = MeshDamage::subdivide;
  twice.size = 2;
  recipe.damage.push_back(twice);
  EXPECT_EQ(write_recipe(recipe, shapes(folder), folder / "."), "");
  Diagnostics out;
  const auto mesh = read_mesh(folder / "ball.ply", 1e-3, out);
  ASSERT_TRUE(mesh);
  for (const Vec3& v : mesh->vertices) EXPECT_NEAR(v.norm(), 0.02, 1e-15);
  const std::string first = test::read_file(folder / "ball.ply");
  EXPECT_EQ(write_recipe(recipe, shapes(folder), folder / "."), "");
  EXPECT_EQ(first, test::read_file(folder / "ball.ply"));
}

TEST(HardCaseMesh, SolidsAndTextsAndWhatIsNotThere) {
  const test::TemporaryFolder folder;
  MeshRecipe recipe;
  recipe.file = "slab.stl";
  recipe.shape = "slab";
  recipe.edge = 2e-3;
  EXPECT_EQ(write_recipe(recipe, shapes(folder), folder / "."), "");
  EXPECT_GT(test::read_file(folder / "slab.stl").size(), 1000u);
  recipe.text = "v 0 0 0\n";
  EXPECT_EQ(write_recipe(recipe, shapes(folder), folder / "."), "");
  EXPECT_EQ(test::read_file(folder / "slab.stl"), recipe.text);
  recipe.text.clear();
  recipe.shape = "cube";
  EXPECT_NE(write_recipe(recipe, shapes(folder), folder / ".").find("cube"), std::string::npos);
}

}  // namespace
}  // namespace genu
