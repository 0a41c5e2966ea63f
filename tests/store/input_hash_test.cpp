#include "genu/store/input_hash.h"

#include <gtest/gtest.h>

#include "genu/core/file_checksum.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

TEST(InputHash, OfTheSceneAndItsMeshesInTheirOrder) {
  const test::TemporaryFolder folder;
  Scene scene;
  scene.file = folder.write("scene.toml", "knee");
  SurfaceDef mesh;
  mesh.shape = SurfaceDef::Shape::mesh;
  mesh.file = folder / "missing.stl";
  scene.surfaces.push_back(mesh);
  const std::vector<std::pair<std::string, std::string>> expected = {{scene.file, checksum("knee").xxh128},
                                                                     {mesh.file.text(), ""}};
  InputFiles files;
  EXPECT_EQ(input_hashes(scene, files), expected);
}

TEST(InputHash, OfChangesIsThatOfTheirPlacesAndValues) {
  Scene scene;
  const std::string none = change_hash(scene);
  scene.changed.edits.push_back({{}, "ligament.AAC.stiffness", "2"});
  const std::string two = change_hash(scene);
  scene.changed.edits.back().text = "3";
  EXPECT_TRUE(none != two && two != change_hash(scene) && none != change_hash(scene));
}

}  // namespace
}  // namespace genu
