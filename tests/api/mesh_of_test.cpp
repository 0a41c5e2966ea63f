// Meshes in memory: the same as the files that they stand for, and those that are none.
#include "genu/api/meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "api/knee.h"
#include "genu/api/scene.h"
#include "genu/mesh_files/mesh_reader.h"
#include "support/temporary_folder.h"

namespace genu::api {
namespace {

using ::testing::HasSubstr;

/// A regular tetrahedron of 40 mm.
Triangles tetrahedron() {
  return {{{0, 0, 0}, {40, 0, 0}, {0, 40, 0}, {0, 0, 40}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

std::string refusal(const Triangles& mesh, const std::string& unit = "mm") {
  return refusal_of([&] { (void)check_mesh(mesh, unit); });
}

TEST(CheckMesh, CountsAndGuessesTheUnit) {
  const MeshCheck found = check_mesh(tetrahedron());
  EXPECT_EQ(found.triangles, 4U);
  EXPECT_EQ(found.vertices, 4U);
  EXPECT_EQ(found.unit, "mm");
  EXPECT_TRUE(found.guessed);
  EXPECT_FALSE(found.findings.empty());
}

TEST(CheckMesh, RefusesWhatIsNoMesh) {
  Triangles mesh = tetrahedron();
  mesh.triangles[1][2] = 4;
  EXPECT_THAT(refusal(mesh), HasSubstr("has a triangle with vertex 4, and its vertices are 0 to 3"));
  EXPECT_THAT(refusal({{{0, 0, 0}}, {}}), HasSubstr("has no triangles"));
  mesh = tetrahedron();
  mesh.vertices[0][0] = std::nan("");
  EXPECT_FALSE(refusal(mesh).empty());
  EXPECT_THAT(refusal(tetrahedron(), "dm"), HasSubstr("must be one of \"mm\", \"m\", \"cm\", \"inch\", \"um\""));
  EXPECT_THROW((void)check_mesh("no/such/file.stl"), SceneError);
}

TEST(Meshes, InMemoryStandInForFiles) {
  const std::string folder = genu::test::source_folder() + "/meshes/lenhart_polynomial/";
  std::map<std::string, Triangles> meshes;
  for (const char* name : {"stl-2mm/femur_cartilage_medial.stl", "stl-4mm/tibia_cartilage_medial.stl",
                           "stl-2mm/femur_cartilage_lateral.stl", "stl-4mm/tibia_cartilage_lateral.stl"}) {
    Diagnostics out;
    const auto mesh = read_mesh(folder + name, 1, out);
    ASSERT_TRUE(mesh);
    Triangles& triangles = meshes[name];
    for (const Vec3& v : mesh->vertices) triangles.vertices.push_back({v.x(), v.y(), v.z()});
    triangles.triangles = mesh->triangles;
  }
  const Scene files = load(folder + "scene-cells.toml"), memory = load(folder + "scene-cells.toml", meshes);
  const std::vector<double> q = files.start();
  EXPECT_EQ(memory.residual(q), files.residual(q));
  for (auto& v : meshes.begin()->second.vertices) v[1] += 0.1;
  EXPECT_NE(load(folder + "scene-cells.toml", meshes).residual(q), files.residual(q));
  const test::TemporaryFolder elsewhere;  // without the files
  const std::string scene = elsewhere.write("scene.toml", text_of(folder + "scene-cells.toml"));
  EXPECT_NE(load(scene, meshes).residual(q), files.residual(q));
  meshes.erase("stl-2mm/femur_cartilage_medial.stl");
  EXPECT_THROW((void)load(scene, meshes), SceneError);
  meshes.emplace("fibula.stl", tetrahedron());
  EXPECT_THROW((void)load(folder + "scene-cells.toml", meshes), SceneError);
}

}  // namespace
}  // namespace genu::api
