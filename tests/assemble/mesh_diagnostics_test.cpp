#include "genu/assemble/mesh_diagnostics.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(MeshDiagnostics, StandAtTheKeyThatNamesTheFile) {
  Scene scene;
  scene.file = "scene.toml";
  Diagnostics found, out;
  found.error(Code::mesh_unreadable, "bone.stl", "is empty");
  found.error(Code::no_such_file, "other.mtl", "is missing");
  PieceFiles files("bone.stl");
  files.where = {{4, 7}};
  add_at_key(scene, "body.tibia.solid.file", files, found, out);
  ASSERT_EQ(out.items().size(), 2u);
  EXPECT_EQ(to_string(out.items()[0]), "scene.toml:4:7: body.tibia.solid.file = \"bone.stl\": is empty");
  EXPECT_EQ(out.items()[1].rule, "other.mtl: is missing") << "of a file that the mesh itself names";
}

TEST(MeshDiagnostics, OfAListStandAtTheFileThatTheyAreAbout) {
  Scene scene;
  scene.file = "scene.toml";
  Diagnostics found, out;
  PieceFiles files;
  files.paths = {"medial.stl", "lateral.stl"};
  files.where = {{4, 9}, {5, 9}};
  found.error(Code::mesh_unreadable, "lateral.stl", "is empty");
  found.warning(Code::mesh_repaired, files.text(), "is inside out");
  add_at_key(scene, "surface.tibia.file", files, found, out);
  ASSERT_EQ(out.items().size(), 2u);
  EXPECT_EQ(to_string(out.items()[0]), "scene.toml:5:9: surface.tibia.file = \"lateral.stl\": is empty");
  EXPECT_EQ(to_string(out.items()[1]),
            "scene.toml:4:9: warning: surface.tibia.file = \"medial.stl, lateral.stl\": is inside out");
}

}  // namespace
}  // namespace genu
