#include "genu/run/scene_edit.h"

#include <gtest/gtest.h>

#include "run/meshed_scene.h"

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
  with_fitted_surfaces(file, *scene, {{0, "medial", "femur_medial", "tibia_medial"}}, {}, folder / "out", out);
  ASSERT_TRUE(out.has_errors());
  EXPECT_EQ(out.items().back().key, "contact.medial");
}

}  // namespace
}  // namespace genu
