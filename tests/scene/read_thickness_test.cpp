#include "scene/scene_text.h"
#include "support/temporary_folder.h"

namespace genu::scene_test {
namespace {

const std::string kRigid = "model = \"rigid\"";
const std::string kLayerWithoutThickness = "model = \"cartilage\"\nmodulus = 10\npoisson = 0.45";
const std::string kRadius = "radius = 20\n", kFloor = "shape = \"plane\"\n";

std::string scene(const std::string& ball, const std::string& floor, const std::string& contact) {
  return edited(kRadius, kRadius + ball,
                edited(kFloor, kFloor + floor, edited(kRigid, kLayerWithoutThickness + contact)));
}

TEST(ReadThickness, SumOfBothSurfaces) {
  Diagnostics out;
  const auto read = parse_scene(scene("thickness = 2\n", "thickness = 1.5\n", ""), "scene.toml", out);
  ASSERT_TRUE(read) << all_messages(out);
  EXPECT_DOUBLE_EQ(read->layers[0].thickness, 3.5e-3);
  EXPECT_DOUBLE_EQ(read->layers[0].search_depth, 3.5e-3);
  EXPECT_FALSE(read->layers[0].measured);
}

TEST(ReadThickness, DownToABone) {
  const test::TemporaryFolder folder;
  folder.write("bone.stl", "solid\nendsolid\n");
  const std::string text = scene("thickness = { bone = \"bone.stl\", units = \"m\", minimum = 0.3, maximum = 8 }\n",
                                 "thickness = 0\n", "\nsearch_depth = 4");
  Diagnostics out;
  const auto read = read_scene(folder.write("scene.toml", text), out);
  ASSERT_TRUE(read) << all_messages(out);
  ASSERT_TRUE(read->surfaces[0].thickness && read->surfaces[1].thickness);
  const SurfaceDef::Thickness& measured = *read->surfaces[0].thickness;
  EXPECT_TRUE(measured.measured);
  EXPECT_EQ(measured.bone, folder / "bone.stl");
  EXPECT_EQ(measured.bone_unit, 1);
  EXPECT_DOUBLE_EQ(measured.least, 0.3e-3);
  EXPECT_DOUBLE_EQ(measured.most, 8e-3);
  EXPECT_FALSE(read->surfaces[1].thickness->measured);
  EXPECT_TRUE(read->layers[0].measured);
  EXPECT_EQ(read->layers[0].thickness, 0);
  EXPECT_DOUBLE_EQ(read->layers[0].search_depth, 4e-3);
}

TEST(ReadThickness, Refused) {
  const std::string contact = "contact.medial.thickness", ball = "surface.ball.thickness";
  const auto marked = [](const std::string& text) {
    return text.substr(0, text.find("[contact.")) + "[contact.@" + text.substr(text.find("[contact.") + 9);
  };
  expect_one_error(marked(scene("", "", "")), contact, "", "is missing");
  expect_one_error(marked(scene("thickness = 2\n", "", "")), contact, "", "surface.floor has none of its own");
  expect_one_error(marked(scene("thickness = 0\n", "thickness = 0\n", "")), contact, "", "without cartilage");
  expect_one_error(scene("thickness = 2\n", "", "\nthickness = @6"), contact, "6",
                   "surface.ball has a thickness of its own");
  expect_one_error(scene("thickness = @-1\n", "thickness = 1\n", ""), ball, "-1", "must be >= 0 mm");
  expect_one_error(scene("thickness = { bone = @\"no.stl\", units = \"m\" }\n", "thickness = 1\n", ""), ball + ".bone",
                   "\"no.stl\"", "no such file");
  expect_one_error(edited(kRadius, kRadius + "thickness = @2\n"), ball, "", "no contact with model = \"cartilage\"");
}

TEST(ReadThickness, KeysOfABone) {
  const test::TemporaryFolder folder;
  folder.write("bone.stl", "solid\nendsolid\n");
  const auto messages = [&](const std::string& more) {
    Diagnostics out;
    const std::string text = scene("thickness = { bone = \"bone.stl\"" + more + " }\n", "thickness = 1\n", "");
    EXPECT_FALSE(read_scene(folder.write("scene.toml", text), out));
    EXPECT_EQ(out.items().size(), 1u) << all_messages(out);
    return all_messages(out);
  };
  EXPECT_NE(messages("").find("surface.ball.thickness.units: is missing"), std::string::npos) << messages("");
  EXPECT_NE(messages(", units = \"dm\"").find("must be one of"), std::string::npos);
  EXPECT_NE(messages(", units = \"m\", minimum = 3, maximum = 2").find("must be > minimum"), std::string::npos);
  EXPECT_NE(messages(", units = \"m\", thick = 3").find("is no key of a thickness down to a bone"), std::string::npos);
}

}  // namespace
}  // namespace genu::scene_test
