#include "genu/assemble/scene_edit.h"

#include <gtest/gtest.h>

#include "support/meshed_scene.h"

namespace genu {
namespace {

TEST(SceneEdit, RefusesTablesItCannotCutOut) {
  const test::TemporaryFolder folder;
  Diagnostics out;
  std::string text = test::text_of(test::meshed_scene(folder));
  const std::size_t at = text.find("[contact.medial]"), end = text.find("\n[", at + 1);
  text.replace(at, end - at,
               "[contact]\nmedial = { surfaces = [\"femur_medial\", \"tibia_medial\"], model = \"rigid\" }\n");
  const std::string file = folder.write("inline.toml", text);
  const auto scene = read_scene(file, out);
  for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
  ASSERT_TRUE(scene);
  const std::vector<FittedPair> pairs = {{0, "medial", "femur_medial", "tibia_medial"}};
  const std::string ignored = with_fitted_surfaces(file, *scene, pairs, {}, folder / "out", out);
  ASSERT_TRUE(out.has_errors());
  EXPECT_EQ(out.items().back().key, "contact.medial");
}

/// A surface of a layer that stays keeps its bone, told from the new scene's folder.
TEST(SceneEdit, BonesAreToldFromTheNewFolder) {
  const test::TemporaryFolder folder;
  Diagnostics out;
  std::string text = test::text_of(test::meshed_scene(folder));
  const std::string bone = "\nthickness = { bone = [\"femur_lateral.ply\", \"femur_medial.ply\"], units = \"mm\" }";
  for (const std::string name : {"femur_lateral", "tibia_lateral"}) {
    const std::size_t end = text.find('\n', text.find("units = \"mm\"", text.find("[surface." + name + "]")));
    text.insert(end, name == "femur_lateral" ? bone : "\nthickness = 2");
  }
  const std::size_t model = text.find("model = \"rigid\"", text.find("[contact.lateral]"));
  text.replace(model, 15, "model = \"cartilage\"\nmodulus = 5\npoisson = 0.4");
  const std::string file = folder.write("layered.toml", text);
  const auto scene = read_scene(file, out);
  ASSERT_TRUE(scene) << to_string(out.items().front());
  const std::string edited =
      with_fitted_surfaces(file, *scene, {{0, "medial", "femur_medial", "tibia_medial"}}, {}, folder / "new/out", out);
  EXPECT_FALSE(out.has_errors());
  EXPECT_NE(edited.find("bone = [\"../../femur_lateral.ply\", \"../../femur_medial.ply\"]"), std::string::npos)
      << edited;
}

TEST(SceneEdit, SolidsOfBodiesAreToldFromTheNewFolder) {
  const test::TemporaryFolder folder;
  Diagnostics out;
  std::string text = test::text_of(test::meshed_scene(folder));
  text.insert(text.find("format = 1") + 10, "\ngravity = [0, -9.81, 0]");
  text.insert(text.find("[body.femur]") + 12,
              "\nsolid = { file = \"femur_lateral.ply\", units = \"mm\", density = 1200 }");
  const std::string file = folder.write("heavy.toml", text);
  const auto scene = read_scene(file, out);
  ASSERT_TRUE(scene) << to_string(out.items().front());
  const std::string edited = with_fitted_surfaces(file, *scene, {}, {}, folder / "new/out", out);
  EXPECT_FALSE(out.has_errors());
  EXPECT_NE(edited.find("solid = { file = \"../../femur_lateral.ply\""), std::string::npos) << edited;
}

}  // namespace
}  // namespace genu
