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
  add_at_key(scene, {4, 7}, "body.tibia.solid.file", "bone.stl", found, out);
  ASSERT_EQ(out.items().size(), 2u);
  EXPECT_EQ(to_string(out.items()[0]), "scene.toml:4:7: body.tibia.solid.file = \"bone.stl\": is empty");
  EXPECT_EQ(out.items()[1].rule, "other.mtl: is missing") << "of a file that the mesh itself names";
}

}  // namespace
}  // namespace genu
