// Meshes with rims and steps that are no noise: poses against closed forms with what is chosen by itself.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_writer.h"
#include "genu/shape_fit/solid_mesh.h"
#include "genu/study/run_scene.h"
#include "support/scene_model.h"
#include "support/scenes.h"
#include "support/solved.h"
#include "support/voxels.h"

namespace genu {
namespace {

/// A block of 44 x 44 x 14 mm with edges rounded by `rounding`, and a dish of radius 40 mm, 4 mm deep, in its top.
Mesh insert(double edge, double rounding) {
  SolidPart block;
  block.shape = SolidPart::Shape::box;
  block.placement.p = {0, 0, -7e-3};
  block.radii = {44e-3, 44e-3, 14e-3};
  block.radius = rounding;
  SolidPart dish;
  dish.operation = SolidPart::Operation::cut;
  dish.placement.p = {0, 0, 36e-3};
  dish.radius = 40e-3;
  std::string why;
  Mesh mesh = solid_mesh(SolidField({block, dish}), edge, why);
  EXPECT_EQ(why, "");
  return mesh;
}

/// A ball of 20 mm in the dish under 100 N down and H = 0 to 30 N aside: it lies where the dish leans by atan(H / 100).
TEST(CreasedMeshes, TheRimOfAnInsertIsNoNoise) {
  for (const double rounding : {0.0, 2e-3})
    for (const double edge : {0.75e-3, 1.5e-3, 3e-3}) {
      const test::TemporaryFolder folder;
      ASSERT_EQ(write_ply(insert(edge, rounding), folder / "insert.ply", 1e-3, ""), "");
      const std::string text =
          test::bone_on_ground("{ z = 16 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
          test::surface("insert", "ground", "mesh", "file = \"insert.ply\"\nunits = \"mm\"") +
          test::contact("c", "ball", "insert") + test::load("w", "force = [0, 0, -100]") +
          test::load("h", "force = [30, 0, 0]") +
          test::step("prescribe = { " + test::kNoTurn + " }\nload = { h = [0, 1] }\nincrements = 6");
      Diagnostics out;
      const auto prepared = prepare(folder.write("scene.toml", text), out);
      ASSERT_TRUE(prepared) << test::messages(out);
      ContactField field(prepared->model);
      const Solution solution = test::judged(*prepared, solve(*prepared, field, {}));
      ASSERT_EQ(solution.summary.poses_solved, 7) << 1e3 * edge;
      double worst = 0;
      for (std::size_t row = 0; row < 7; ++row) {
        const double lean = std::atan(0.05 * static_cast<double>(row));
        worst = std::max({worst, std::abs(solution.poses.number(row, "j.x_mm") - 20 * std::sin(lean)),
                          std::abs(solution.poses.number(row, "j.z_mm") - 36 + 20 * std::cos(lean))});
      }
      std::printf("edges of %.2f mm, rim of %.0f mm: off by at most %.4f mm\n", 1e3 * edge, 1e3 * rounding, worst);
      EXPECT_LT(worst, 0.03);
    }
}

/// A level spring of the ball's axis, which holds it upright.
std::string held(const std::string& name, const std::string& height, const std::string& x) {
  const double above = 20 + std::stod(height);
  return test::ligament(name, "[0, 0, " + height + "]", "[" + x + ", 0, " + std::to_string(above) + "]",
                        "law = \"spring\"\nstiffness = 20\nreference_force = 0");
}

/// A ball of 20 mm as slices of an image, resting on a floor: its centre is 20 mm above it, within the error bar.
TEST(CreasedMeshes, AStaircaseIsToldAndItsErrorCovered) {
  for (const double slice : {1e-3, 2.5e-3}) {
    const test::TemporaryFolder folder;
    const Mesh ball = test::voxel_faces([](const Vec3& x) { return x.norm() < 20e-3; }, {0.7e-3, 0.7e-3, slice}, 22e-3);
    ASSERT_EQ(write_ply(ball, folder / "ball.ply", 1e-3, ""), "");
    const std::string text = test::bone_on_ground("{ z = 20 }") +
                             test::surface("ball", "bone", "mesh", "file = \"ball.ply\"\nunits = \"mm\"") +
                             test::surface("floor", "ground", "plane") + test::contact("c", "ball", "floor") +
                             held("top_l", "10", "-40") + held("top_r", "10", "40") + held("low_l", "-10", "-40") +
                             held("low_r", "-10", "40") + test::load("w", "force = [0, 0, -100]") +
                             test::step("prescribe = { \"j.a\" = [0, 0.5], \"j.c\" = 0, \"j.y\" = 0 }\nincrements = 5");
    RunOptions options;
    options.error_bars = true;
    Diagnostics out;
    Solution solution;
    EXPECT_NE(run_scene(folder.write("scene.toml", text), folder / "out", options, out, &solution), kExitRefused);
    EXPECT_TRUE(std::any_of(out.items().begin(), out.items().end(), [](const Diagnostic& d) {
      return d.code == Code::mesh_coordinates;
    })) << test::messages(out);
    ASSERT_EQ(solution.summary.poses_solved, 6);
    ASSERT_TRUE(solution.error_bars.has_value());
    for (std::size_t row = 0; row < 6; ++row) {
      const double off = solution.poses.number(row, "j.z_mm") - 20,
                   bar = solution.error_bars->bars.number(row, "j.z_mm");
      std::printf("slices of %.1f mm, row %zu: off by %.3f mm, error bar %.3f mm\n", 1e3 * slice, row + 1, off, bar);
      EXPECT_LT(std::abs(off), bar);
      EXPECT_LT(bar, 6);  // faces of voxels are no shape to fit: smoothing them first is what helps
    }
  }
}

}  // namespace
}  // namespace genu
