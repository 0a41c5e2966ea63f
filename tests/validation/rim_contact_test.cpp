// Contact that slides over the rim of an open mesh: by shares of triangles every pose can be solved, and where
// triangles count wholly or not at all (rim = "cut") some have no equilibrium.
#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_reader.h"
#include "genu/mesh_files/mesh_writer.h"
#include "support/data.h"
#include "support/judged.h"
#include "support/layers.h"
#include "support/scene_model.h"
#include "support/scenes.h"
#include "support/ssm_scene.h"

namespace genu {
namespace {

struct Outcome {
  ResultTable poses;
  int solved = 0;
};

Outcome solve_text(const test::TemporaryFolder& folder, const std::string& text) {
  Diagnostics out;
  Solution solution;
  EXPECT_NE(run_scene(folder.write("scene.toml", text), folder / "out", {}, out, &solution), kExitRefused);
  EXPECT_FALSE(out.has_errors()) << test::messages(out);
  test::expect_judged_ok(folder / "scene.toml", solution.poses);
  return {solution.poses, solution.summary.poses_solved};
}

/// A ball between two springs, pushed over the edge of a plate.
TEST(RimContact, ABallIsPushedOverTheEdgeOfAPlate) {
  const test::TemporaryFolder folder;
  ASSERT_EQ(write_ply(test::sheet(10e-3, 20), folder / "plate.ply", 1e-3, ""), "");
  ASSERT_EQ(write_ply(test::ball(20e-3, 1e-3), folder / "ball.ply", 1e-3, ""), "");
  const auto scene = [](const std::string& rim) {
    const std::string spring = "law = \"spring\"\nstiffness = 10\nreference_force = 0";
    return test::bone_on_ground("{ z = 19.8 }") +
           test::surface("ball", "bone", "mesh", "file = \"ball.ply\"\nunits = \"mm\"") +
           test::surface("plate", "ground", "mesh", "file = \"plate.ply\"\nunits = \"mm\"") +
           test::layer("foot", "plate", "ball",
                       "quadrature = \"triangles\"\ncast_from = \"ball\"\nrim = \"" + rim + "\"") +
           test::ligament("l", "[0, 0, 0]", "[-40, 0, 19.8]", spring) +
           test::ligament("r", "[0, 0, 0]", "[40, 0, 19.8]", spring) + test::load("w", "force = [0, 0, -100]") +
           test::load("push", "force = [1, 0, 0]") +
           test::step(
               "prescribe = { \"j.y\" = 0, \"j.a\" = 0, \"j.b\" = 0, \"j.c\" = 0 }\n"
               "load = { push = [0, 215] }\nincrements = 60");
  };
  const Outcome weighted = solve_text(folder, scene("weighted")), cut = solve_text(folder, scene("cut"));
  std::printf("%d poses solved of 61, %d without weights, to x = %.2f mm\n", weighted.solved, cut.solved,
              weighted.poses.number(weighted.poses.rows() - 1, "j.x_mm"));
  EXPECT_EQ(weighted.solved, 61);
  EXPECT_LT(cut.solved, 61);
}

/// The triangles of a mesh whose centroid lies at y > `from` (m).
Mesh trimmed(const Mesh& whole, double from) {
  Mesh mesh;
  std::vector<int> index(whole.vertices.size(), -1);
  for (std::array<int, 3> t : whole.triangles) {
    double y = 0;
    for (const int v : t) y += whole.vertices[at(v)].y() / 3;
    if (!(y > from)) continue;
    for (int& v : t) {
      int& own = index[at(v)];
      if (own < 0) {
        own = static_cast<int>(mesh.vertices.size());
        mesh.vertices.push_back(whole.vertices[at(v)]);
      }
      v = own;
    }
    mesh.triangles.push_back(t);
  }
  return mesh;
}

/// Knees of the shape model without the posterior part of the femur's cartilage: from 0 to 20 deg the contact rolls
/// over a rim of whole triangles, as a segmentation leaves it.
TEST(RimContact, KneesRollOverARaggedRim) {
  int cut_solved = 0, poses = 0;
  for (const std::string subject : {"S001", "S002", "mean"}) {
    const std::string file = "ssm/" + subject + "_Femur_Cartilage.ply";
    GENU_NEEDS_DATA(file);
    Diagnostics out;
    const auto whole = read_mesh(test::data_path(file), 1e-3, out);
    ASSERT_TRUE(whole) << test::messages(out);
    for (const double from : {-4e-3, 0.0}) {
      const test::TemporaryFolder folder;
      ASSERT_EQ(write_ply(trimmed(*whole, from), folder / "femur.ply", 1e-3, ""), "");
      const auto scene = [&](const std::string& rim) {
        const std::string layer =
            "model = \"cartilage\"\nmodulus = 10\npoisson = 0.45\nthickness = 6\nquadrature = \"triangles\"\n"
            "cast_from = \"tibia_cartilage\"\nrim = \"" +
            rim + "\"";
        const std::string text = test::replaced(test::ssm_scene(subject, 20, 20), "model = \"rigid\"", layer);
        return test::replaced(text, test::data_path(file), folder / "femur.ply");
      };
      const Outcome weighted = solve_text(folder, scene("weighted")), cut = solve_text(folder, scene("cut"));
      std::printf("%s, from y = %g mm: %d poses solved of 21, %d without weights\n", subject.c_str(), 1e3 * from,
                  weighted.solved, cut.solved);
      EXPECT_EQ(weighted.solved, 21) << subject << " " << from;
      cut_solved += cut.solved;
      poses += 21;
    }
  }
  EXPECT_LT(cut_solved, poses - 10);
}

}  // namespace
}  // namespace genu
