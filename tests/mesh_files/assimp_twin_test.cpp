// The readers of genu's own against assimp's, which keeps single precision; and what only assimp reads.
#include <gtest/gtest.h>

#include "genu/core/file_text.h"
#include "genu/mesh_files/mesh_formats.h"
#include "genu/mesh_files/mesh_reader.h"
#include "support/data.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

/// The corners of all triangles, one after the other.
std::vector<Vec3> corners(const Mesh& mesh) {
  std::vector<Vec3> out;
  for (const auto& t : mesh.triangles)
    for (const int v : t) out.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
  return out;
}

void expect_same(const std::string& path, std::string (*own)(std::string_view, Mesh&)) {
  Mesh a, b;
  Diagnostics out;
  const auto bytes = text_of_file(path, out);
  ASSERT_TRUE(bytes) << path;
  ASSERT_EQ(own(*bytes, a), "");
  ASSERT_EQ(read_by_assimp(path, *bytes, b), "");
  const std::vector<Vec3> x = corners(a), y = corners(b);
  ASSERT_EQ(x.size(), y.size()) << path;
  double worst = 0, largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    worst = std::max(worst, (x[i] - y[i]).norm());
    largest = std::max(largest, x[i].norm());
  }
  EXPECT_LE(worst, 2e-7 * largest) << path;
}

TEST(AssimpTwin, TheMeasuredKnee) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart.obj");
  expect_same(test::data_path("lenhart2015/ACLC01-R-tibia-cart.stl"), read_stl);
  expect_same(test::data_path("lenhart2015/ACLC01-R-femur-cart.obj"), read_obj);
}

TEST(AssimpTwin, TheSyntheticKnees) {
  GENU_NEEDS_DATA("ssm/S001_Tibia_Cartilage.ply");
  expect_same(test::data_path("ssm/S001_Tibia_Cartilage.ply"), read_ply);
  expect_same(test::data_path("ssm/mean_Femur_Cartilage.ply"), read_ply);
}

/// A scene graph: the same triangle twice, the second one turned by a quarter about z and moved.
TEST(AssimpTwin, MeshesOfASceneGraphStandInItsRootsFrame) {
  const test::TemporaryFolder folder;
  const std::string dae = R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g" name="g"><mesh>
<source id="p"><float_array id="pa" count="9">1 0 0 2 0 0 1 3 0</float_array>
<technique_common><accessor source="#pa" count="3" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">
<node id="a"><instance_geometry url="#g"/></node>
<node id="b"><matrix>0 -1 0 0  1 0 0 0  0 0 1 5  0 0 0 1</matrix><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
)";
  Diagnostics out;
  const auto mesh = read_mesh(folder.write("two.dae", dae), 1, out);
  ASSERT_TRUE(mesh) << (out.items().empty() ? "" : out.items()[0].rule);
  ASSERT_EQ(mesh->triangles.size(), 2u);
  const std::vector<Vec3> expected = {{1, 0, 0}, {2, 0, 0}, {1, 3, 0}, {0, 1, 5}, {0, 2, 5}, {-3, 1, 5}};
  for (const Vec3& p : expected) {
    double nearest = 1;
    for (const Vec3& q : corners(*mesh)) nearest = std::min(nearest, (p - q).norm());
    EXPECT_LT(nearest, 1e-6) << p.transpose();
  }
}

TEST(AssimpTwin, BrokenFilesAreRefused) {
  const test::TemporaryFolder folder;
  for (const char* name : {"a.glb", "a.dae", "a.3ds", "a.gltf", "a.amf"}) {
    Diagnostics out;
    EXPECT_FALSE(read_mesh(folder.write(name, "no mesh at all"), 1, out)) << name;
    EXPECT_TRUE(out.has_errors());
  }
}

}  // namespace
}  // namespace genu
