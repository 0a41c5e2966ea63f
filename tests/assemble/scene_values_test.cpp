#include "genu/assemble/scene_values.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "genu/scene/reader.h"
#include "support/leskovar.h"
#include "support/scenes.h"

namespace genu {
namespace {

std::optional<Parameter> named(const Scene& scene, const std::string& name) {
  for (const Parameter& p : parameters_of(scene))
    if (p.name == name) return p;
  return std::nullopt;
}

TEST(SceneValues, NothingElseIsTouched) {
  const std::string file = test::kLeskovar + "calibration.toml";
  Diagnostics out;
  const auto scene = read_scene(file, out);
  ASSERT_TRUE(scene);
  EXPECT_EQ(with_values(file, *scene, {}, "/tmp/elsewhere", out), test::read_file(file));
  const double si = 0.5535 * 180 / M_PI;
  const std::string text = with_values(file, *scene, {{*named(*scene, "j1.stiffness"), si}}, "/tmp/elsewhere", out);
  const std::size_t at = text.find("stiffness = 0.553");
  ASSERT_NE(at, std::string::npos);
  EXPECT_NEAR(std::stod(text.substr(at + 12)), 0.5535, 1e-15);
  EXPECT_NE(text.find("# N m per degree, 0.5535 in truth"), std::string::npos) << "comments stay";
  EXPECT_TRUE(out.items().empty()) << test::messages(out);
}

TEST(SceneValues, MeshesAreFoundFromTheNewFolder) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "knee");
  std::filesystem::create_directories(folder / "out/deep");
  for (const char* bone : {"tibia.stl", "patella.stl"})
    std::filesystem::copy(test::kLeskovar + bone, folder / (std::string("knee/") + bone));
  const std::string file = folder.write("knee/scene.toml", test::read_file(test::kLeskovar + "scene-bones.toml"));
  Diagnostics out;
  const auto scene = read_scene(file, out);
  ASSERT_TRUE(scene) << test::messages(out);
  const std::string text = with_values(file, *scene, {}, folder / "out/deep", out);
  EXPECT_NE(text.find("\"../../knee/tibia.stl\""), std::string::npos) << text;
  EXPECT_TRUE(parse_scene(text, folder / "out/deep/scene.toml", out)) << test::messages(out);
}

TEST(SceneValues, SoAreThePiecesOfAMesh) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "knee");
  for (const char* bone : {"tibia.stl", "patella.stl"})
    std::filesystem::copy(test::kLeskovar + bone, folder / (std::string("knee/") + bone));
  std::string scene_text = test::read_file(test::kLeskovar + "scene-bones.toml");
  const std::string one = "file = \"tibia.stl\"", two = "file = [\"tibia.stl\", \"patella.stl\"]";
  ASSERT_NE(scene_text.find(one), std::string::npos);
  scene_text.replace(scene_text.find(one), one.size(), two);
  const std::string file = folder.write("knee/scene.toml", scene_text);
  Diagnostics out;
  const auto scene = read_scene(file, out);
  ASSERT_TRUE(scene) << test::messages(out);
  const std::string text = with_values(file, *scene, {}, folder / "out", out);
  EXPECT_NE(text.find("file = [\"../knee/tibia.stl\", \"../knee/patella.stl\"]"), std::string::npos) << text;
  EXPECT_NE(with_mesh_names(scene_text, [](const std::string& name) { return "x" + name; })
                .find("[\"xtibia.stl\", \"xpatella.stl\"]"),
            std::string::npos);
}

TEST(SceneValues, SaysWhatTheFileDoesNotSay) {
  const std::string file = test::kLeskovar + "scene.toml";
  Diagnostics out;
  const auto scene = read_scene(file, out);
  ASSERT_TRUE(scene);
  const std::string ignored = with_values(file, *scene, {{*named(*scene, "drive.value"), 2}}, "/tmp", out);
  ASSERT_EQ(out.items().size(), 1u);
  EXPECT_EQ(out.items()[0].key, "load.drive.value");
  EXPECT_NE(out.items()[0].rule.find("is not said by the scene"), std::string::npos);
}

}  // namespace
}  // namespace genu
