#include "genu/assemble/drawn_meshes.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "genu/assemble/changed_scene.h"
#include "genu/mesh_care/noise_field.h"
#include "support/meshed_ball.h"
#include "support/scenes.h"
#include "support/text.h"

namespace genu {
namespace {

const MeshNoise kDrawnNoise{20e-6, 15e-3};

Prepared ready_ball(const std::string& file) {
  Diagnostics out;
  auto prepared = prepare(SceneSource(file), out);
  EXPECT_TRUE(prepared) << test::messages(out);
  return prepared ? std::move(*prepared) : Prepared{};
}

const BlendSurface& skin(const Prepared& prepared) { return *prepared.notes[0].blend; }

TEST(DrawnMeshes, AreMovedAlongTheirNormalsByTheField) {
  const test::TemporaryFolder folder;
  const Prepared ball = ready_ball(test::meshed_ball(folder));
  Diagnostics out;
  const auto drawn = draw_meshes(ball, {{0, kDrawnNoise, 17}}, out);
  ASSERT_TRUE(drawn);
  const Mesh& mesh = (*drawn)[0].mesh;  // mm
  std::vector<Vec3> own;                // the normals of the mesh are those of the ball, but for its edges
  for (const Vec3& v : mesh.vertices) own.push_back(test::kBallRadius * v.normalized());
  const std::vector<double> heights = noise_field(own, kDrawnNoise, 17);
  double off = 0, largest = 0;
  for (std::size_t v = 0; v < own.size(); ++v) {
    off = std::max(off, std::abs(1e-3 * mesh.vertices[v].norm() - test::kBallRadius - heights[v]));
    largest = std::max(largest, std::abs(heights[v]));
  }
  EXPECT_GT(largest, 20e-6);
  EXPECT_LT(off, 1e-2 * largest);
}

TEST(DrawnMeshes, AreFittedAsTheMeshesOfTheScene) {
  const test::TemporaryFolder folder;
  const Prepared ball = ready_ball(test::meshed_ball(folder));
  Diagnostics out;
  const auto drawn = draw_meshes(ball, {{0, {1e-3, 0}, 17}}, out);  // white noise: its own choice would be another one
  ASSERT_TRUE(drawn);
  const auto prepared = prepare_with_meshes(ball.source, ball, *drawn, "a", out);
  ASSERT_TRUE(prepared) << test::messages(out);
  EXPECT_EQ(skin(*prepared).facts().degree, skin(ball).facts().degree);
  EXPECT_NEAR(skin(*prepared).facts().fit_radius, skin(ball).facts().fit_radius, 1e-15);
  const Prepared given = ready_ball(test::meshed_ball(
      folder, test::with_first(test::kMeshedBall, "units = \"mm\"\n", "units = \"mm\"\nfit_radius = 7\ndegree = 2\n")));
  const auto others = draw_meshes(given, {{0, kDrawnNoise, 17}}, out);
  ASSERT_TRUE(others);
  EXPECT_FALSE((*others)[0].fit_radius || (*others)[0].degree) << "the scene says it";
}

TEST(DrawnMeshes, HaveTheSameBitsAsAScene) {
  const test::TemporaryFolder folder;
  for (const char* file : {"file = \"ball.ply\"", "file = [\"ball.ply\",  # [one\n  'cap.ply']"}) {
    const auto cap = make_sphere({}, 5e-3, false);  // a second piece, inside
    ASSERT_EQ(write_ply(cap->triangles(1e-3, Vec3::Zero(), 0.1), folder / "cap.ply", 1e-3, ""), "");
    const Prepared ball =
        ready_ball(test::meshed_ball(folder, test::with_first(test::kMeshedBall, "file = \"ball.ply\"", file)));
    Diagnostics out;
    const auto drawn = draw_meshes(ball, {{0, kDrawnNoise, 17}}, out);
    ASSERT_TRUE(drawn);
    const auto here = prepare_with_meshes(ball.source, ball, *drawn, "a", out);
    ASSERT_TRUE(here) << test::messages(out);
    std::filesystem::create_directories(folder / "written/deep");
    write_scene_with_meshes(ball, *drawn, folder / "written/deep", out);
    ASSERT_FALSE(out.has_errors()) << test::messages(out);
    const Prepared there = ready_ball(folder / "written/deep/scene.toml");
    EXPECT_EQ(skin(*here).mesh().vertices, skin(there).mesh().vertices);
    EXPECT_EQ(skin(*here).facts().fit_radius, skin(there).facts().fit_radius);
    EXPECT_EQ(skin(*here).node_positions(), skin(there).node_positions());
    EXPECT_NE(skin(*here).mesh().vertices, skin(ball).mesh().vertices);
    Diagnostics again;
    EXPECT_FALSE(ball.meshes->read("skin.ply of a", 1, again)) << "it was in the library for the call alone";
  }
}

TEST(DrawnMeshes, NeedAHeaderOfTheirOwnToBeWritten) {
  const test::TemporaryFolder folder;
  const std::string in_line =
      "[surface]\nskin = { body = \"ball\", shape = \"mesh\", file = \"ball.ply\", units = \"mm\" }\n";
  const std::string header = "[surface.skin]\nbody = \"ball\"\nshape = \"mesh\"\nfile = \"ball.ply\"\nunits = \"mm\"\n";
  const Prepared ball = ready_ball(test::meshed_ball(folder, test::with_first(test::kMeshedBall, header, in_line)));
  Diagnostics out;
  const auto drawn = draw_meshes(ball, {{0, kDrawnNoise, 17}}, out);
  ASSERT_TRUE(drawn);
  write_scene_with_meshes(ball, *drawn, folder / ".", out);
  EXPECT_TRUE(test::contains(test::messages(out),
                             "surface.skin: cannot be written with another mesh: give the table a "
                             "header of its own, [surface.skin]"))
      << test::messages(out);
}

}  // namespace
}  // namespace genu
