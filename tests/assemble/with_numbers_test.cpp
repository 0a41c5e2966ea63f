// Other numbers of a prepared joint: the same as a scene read with them, without preparing again what they do not
// change.
#include "genu/assemble/with_numbers.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "genu/scene/reader.h"
#include "genu/study/run_scene.h"
#include "support/data.h"
#include "support/leskovar.h"
#include "support/published_knee.h"
#include "support/scenes.h"
#include "support/text.h"

namespace genu {
namespace {

Parameter named(const Prepared& p, const std::string& name) {
  for (const Parameter& parameter : parameters_of(p.source))
    if (parameter.name == name) return parameter;
  ADD_FAILURE() << name;
  return {};
}

std::string poses_csv(const Prepared& p) {
  ContactField field = contact_field(p);
  return solve(p, field, {}).poses.to_csv();
}

TEST(WithNumbers, SolveToTheSameBytesAsASceneReadWithThem) {
  Diagnostics out;
  auto original = prepare(test::dortmans_file(), out);
  ASSERT_TRUE(original) << test::messages(out);
  share_search(*original);
  const Parameter stiffness = named(*original, "AAC.stiffness"), point = named(*original, "PMC.from.y");
  Scene scene = *read_scene(test::dortmans_file(), out);
  const double k = 0.5 * *parameter_number(scene, stiffness), y = *parameter_number(scene, point) + 1e-3;
  *parameter_number(scene, stiffness) = k;
  *parameter_number(scene, point) = y;
  const auto anew = prepare(scene, std::make_shared<MeshLibrary>(), out);
  const auto changed = with_numbers(*original, {{stiffness, k}, {point, y}}, out);
  ASSERT_TRUE(anew && changed) << test::messages(out);
  EXPECT_EQ(poses_csv(*changed), poses_csv(*anew));
  EXPECT_EQ(changed->surfaces, original->surfaces);
  EXPECT_NE(poses_csv(*changed), poses_csv(*original));
}

TEST(WithNumbers, ShareElasticLayersThatTheyDoNotChange) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart-coarse.stl");
  Diagnostics out;
  const auto scene_read = parse_scene(
      test::published_scene(test::data_path("lenhart2015/ACLC01-R-femur-cart-coarse.stl")), "scene.toml", out);
  ASSERT_TRUE(scene_read) << test::messages(out);
  const auto knee = prepare(*scene_read, std::make_shared<MeshLibrary>(), out);
  ASSERT_TRUE(knee) << test::messages(out);
  ASSERT_FALSE(knee->model.layers.empty());
  for (const Parameter& p : parameters_of(knee->source)) {
    Scene scene = knee->source;
    const double* number = parameter_number(scene, p);
    if (number == nullptr || !p.of_ligament() || p.name.find("stiffness") == std::string::npos) continue;
    const auto changed = with_numbers(*knee, {{p, 2 * *number}}, out);
    ASSERT_TRUE(changed) << test::messages(out);
    EXPECT_EQ(changed->model.layers[0].layer, knee->model.layers[0].layer);
    return;
  }
  ADD_FAILURE() << "no stiffness of a ligament";
}

TEST(WithNumbers, SayWhatCannotBeChanged) {
  Diagnostics out;
  const auto knee = prepare(test::dortmans_file(), out);
  ASSERT_TRUE(knee);
  for (const Parameter& p : parameters_of(knee->source)) {
    if (p.kind != Parameter::Kind::prescribed) continue;
    EXPECT_FALSE(with_numbers(*knee, {{p, 1}}, out));
    ASSERT_EQ(out.items().size(), 1u);
    EXPECT_EQ(out.items()[0].key, p.name);
    return;
  }
}

TEST(WithNumbers, OfASceneInMemoryTouchNoFile) {
  Diagnostics out;
  Scene scene = *read_scene(test::kLeskovar + "scene-bones.toml", out);
  auto meshes = std::make_shared<MeshLibrary>();
  std::vector<std::string> files = mesh_files(scene);
  ASSERT_FALSE(files.empty());
  const auto rename = [](std::string& file) {
    if (!file.empty()) file = "memory/" + std::filesystem::path(file).filename().string();
  };
  for (const std::string& file : files) {
    const auto mesh = read_mesh(file, 1, out);
    ASSERT_TRUE(mesh) << test::messages(out);
    std::string name = file;
    rename(name);
    meshes->put(name, *mesh);
  }
  const auto rename_all = [&](PieceFiles& names) {
    for (std::string& file : names.paths) rename(file);
  };
  for (SurfaceDef& s : scene.surfaces) {
    rename_all(s.file);
    if (s.thickness) rename_all(s.thickness->bone);
  }
  for (BodyDef& b : scene.bodies)
    if (b.solid) rename_all(b.solid->file);
  const auto prepared = prepare(scene, meshes, out);
  EXPECT_TRUE(prepared) << test::messages(out);
}

}  // namespace
}  // namespace genu
