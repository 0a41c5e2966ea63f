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

void expect_same(const std::string& path, std::string (*own)(std::string_view, Mesh&, MeshNotes&)) {
  Mesh a, b;
  Diagnostics out;
  const auto bytes = text_of_file(path, out);
  ASSERT_TRUE(bytes) << path;
  MeshNotes notes;
  ASSERT_EQ(own(*bytes, a, notes), "");
  ASSERT_EQ(read_by_assimp(path, *bytes, b, notes), "");
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

/// A scene graph: the same face twice, the second one turned by a quarter about z and moved.
std::string scene_graph(const std::string& asset, const std::string& face) {
  return R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset>)" +
         asset + R"(</asset>
<library_geometries><geometry id="g" name="g"><mesh>
<source id="p"><float_array id="pa" count="12">1 0 0 2 0 0 1 3 0 1.1 0.1 0</float_array>
<technique_common><accessor source="#pa" count="4" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
)" + face +
         R"(
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">
<node id="a"><instance_geometry url="#g"/></node>
<node id="b"><matrix>0 -1 0 0  1 0 0 0  0 0 1 5  0 0 0 1</matrix><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
)";
}

const std::string kTriangle =
    R"(<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>)";

TEST(AssimpTwin, MeshesOfASceneGraphStandInItsRootsFrame) {
  const test::TemporaryFolder folder;
  for (const char* up : {"X_UP", "Y_UP", "Z_UP"})
    for (const char* metre : {"1", "0.001", "0.0254"}) {
      const std::string asset = std::string("<unit name=\"u\" meter=\"") + metre + "\"/><up_axis>" + up + "</up_axis>";
      Diagnostics out;
      const auto mesh = read_mesh(folder.write("two.dae", scene_graph(asset, kTriangle)), 1, out);
      ASSERT_TRUE(mesh) << (out.items().empty() ? "" : out.items()[0].rule);
      ASSERT_EQ(mesh->triangles.size(), 2u);
      const std::vector<Vec3> expected = {{1, 0, 0}, {2, 0, 0}, {1, 3, 0}, {0, 1, 5}, {0, 2, 5}, {-3, 1, 5}};
      for (const Vec3& p : expected) {
        double nearest = 1e9;
        for (const Vec3& q : corners(*mesh)) nearest = std::min(nearest, (p - q).norm());
        EXPECT_LT(nearest, 1e-6) << p.transpose() << ": neither " << up << " nor the unit turns or scales the numbers";
      }
    }
}

TEST(AssimpTwin, ConcavePolygonsAreCutFromTheReflexCorner) {
  const test::TemporaryFolder folder;
  const std::string quad = R"(<polylist count="1"><input semantic="VERTEX" source="#v" offset="0"/>
<vcount>4</vcount><p>0 1 2 3</p></polylist>)";
  Diagnostics out;
  const auto mesh = read_mesh(folder.write("quad.dae", scene_graph("", quad)), 1, out);
  ASSERT_TRUE(mesh) << (out.items().empty() ? "" : out.items()[0].rule);
  ASSERT_EQ(mesh->triangles.size(), 4u);
  double area = 0;
  for (const auto& t : mesh->triangles) {
    const Vec3& a = mesh->vertices[at(t[0])];
    area += 0.5 * (mesh->vertices[at(t[1])] - a).cross(mesh->vertices[at(t[2])] - a).norm();
  }
  EXPECT_NEAR(area, 2 * (1.5 - 0.15), 1e-6) << "of both sheets: the triangle 0 1 2 without the triangle 0 3 2";
}

std::string chunk(int id, const std::string& body) {
  const std::size_t size = body.size() + 6;
  std::string out{static_cast<char>(id), static_cast<char>(id >> 8)};
  for (int k = 0; k < 4; ++k) out += static_cast<char>(size >> (8 * k) & 0xff);
  return out + body;
}

TEST(AssimpTwin, NumbersOf3dsKeepTheirFrame) {
  const float positions[9] = {1, 0, 0, 2, 0, 0, 1, 3, 0};
  const std::string vertices = std::string("\3\0", 2) + std::string(reinterpret_cast<const char*>(positions), 36);
  const std::string faces = std::string("\1\0\0\0\1\0\2\0\0\0", 10);
  const std::string object =
      chunk(0x4000, std::string("a\0", 2) + chunk(0x4100, chunk(0x4110, vertices) + chunk(0x4120, faces)));
  const test::TemporaryFolder folder;
  Diagnostics out;
  const auto mesh = read_mesh(folder.write("a.3ds", chunk(0x4d4d, chunk(0x3d3d, object))), 1, out);
  ASSERT_TRUE(mesh) << (out.items().empty() ? "" : out.items()[0].rule);
  EXPECT_EQ(mesh->vertices, (std::vector<Vec3>{{1, 0, 0}, {2, 0, 0}, {1, 3, 0}}));
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
