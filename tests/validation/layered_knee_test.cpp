// A measured knee on a layer of cartilage: every pose balances, its forces are those of a plain sum over all rays, and
// where the equilibrium ends the joint goes on in the next one.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_reader.h"
#include "support/judged.h"
#include "support/knee_scene.h"
#include "support/layers.h"
#include "support/scenes.h"

namespace genu {
namespace {

constexpr double kModulus = 10e6, kPoisson = 0.45, kThickness = 6e-3;

std::string layered(const std::string& resolution, double to, int increments, const std::string& load,
                    const std::string& modulus = "10") {
  std::string text = test::lenhart_scene(resolution, 0, to, increments);
  text = test::replaced(text, "model = \"rigid\"",
                        "model = \"cartilage\"\nmodulus = " + modulus +
                            "\npoisson = 0.45\nthickness = 6\nquadrature = \"triangles\"\ncast_from = "
                            "\"tibia_cartilage\"");
  return test::replaced(text, "force = [0, 100, 0]", "force = [0, " + load + ", 0]");
}

Solution solve_text(const std::string& text) {
  const test::TemporaryFolder folder;
  Diagnostics out;
  Solution solution;
  EXPECT_NE(run_scene(folder.write("scene.toml", text), folder / "out", {}, out, &solution), kExitRefused);
  EXPECT_FALSE(out.has_errors()) << test::messages(out);
  test::expect_judged_ok(folder / "scene.toml", solution.poses);
  return solution;
}

Mesh mesh_of(const std::string& bone, const std::string& resolution) {
  Diagnostics out;
  auto mesh = read_mesh(test::data_path("lenhart2015/ACLC01-R-" + bone + "-cart" + resolution + ".stl"), 1, out);
  EXPECT_TRUE(mesh) << test::messages(out);
  return mesh.value_or(Mesh());
}

TEST(LayeredKnee, EveryPoseInThreeIterations) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart.stl");
  const Solution solution = solve_text(layered("", 90, 30, "100"));
  EXPECT_EQ(solution.summary.exit_code, kExitOk);
  EXPECT_EQ(solution.summary.poses_solved, 31);
  EXPECT_EQ(solution.summary.poses_stable, 31);
  std::printf("%d iterations for 31 poses in %d substeps\n", solution.summary.iterations, solution.summary.substeps);
  EXPECT_LE(solution.summary.iterations, 5 * 31);
}

TEST(LayeredKnee, ForcesAreThePlainSum) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart-coarse.stl");
  const Solution solution = solve_text(layered("-coarse", 90, 9, "100"));
  ASSERT_EQ(solution.summary.poses_solved, 10);
  const Mesh femur = mesh_of("femur", "-coarse"), tibia = mesh_of("tibia", "-coarse");
  const LayerLaw law{LayerLaw::Kind::linear, confined_modulus(kModulus, kPoisson)};
  double worst = 0;
  for (std::size_t row = 0; row < solution.records.size(); ++row) {
    // The femur is fixed: its frame is the world's. Body 1 is the tibia, whose triangles cast.
    const Pose& X_FT = solution.records[row].point.pose.state.poses[1];
    const Vec6 wrench = test::wrench_by_all(tibia, femur, X_FT, kThickness, law, kThickness);
    const char* axes[] = {"x", "y", "z"};
    for (int i = 0; i < 3; ++i)
      worst = std::max(
          worst, std::abs(solution.poses.number(row, std::string("tibiofemoral.force_") + axes[i] + "_N") - wrench[i]));
  }
  std::printf("forces differ by at most %.1e N\n", worst);
  EXPECT_LT(worst, 1e-9);
}

/// Under ten times the load, which follows the tibia, the equilibrium ends on the way: the joint snaps and goes on.
TEST(LayeredKnee, SnapsAndGoesOn) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart-medium.stl");
  const Solution solution = solve_text(layered("-medium", 90, 90, "1000"));
  EXPECT_EQ(solution.summary.poses_solved, 91);
  const auto snapped = std::count_if(solution.events.begin(), solution.events.end(),
                                     [](const PathEvent& e) { return e.kind == PathEvent::Kind::snapped; });
  EXPECT_GE(snapped, 1);
  for (std::size_t row = 0; row < solution.poses.rows(); ++row)
    EXPECT_LT(solution.poses.number(row, "residual"), 1e-11) << row;
}

TEST(LayeredKnee, SoftAndStiffAndEveryResolution) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart-wicked-coarse.stl");
  for (const char* resolution : {"-medium", "-coarse", "-wicked-coarse"})
    for (const char* modulus : {"1", "100"}) {
      const Solution solution = solve_text(layered(resolution, 90, 90, "100", modulus));
      EXPECT_EQ(solution.summary.poses_solved, 91) << resolution << " " << modulus << " MPa";
    }
}

/// Where few triangles carry, the equilibrium ends between kinks of the sum: the joint snaps and goes on whatever steps
/// lead there, and tells of nothing that it leaps over.
TEST(LayeredKnee, SnapsTheSameOnSteps) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart-wicked-coarse.stl");
  std::vector<double> rotations;
  for (const int increments : {30, 45, 90, 180}) {
    const Solution solution = solve_text(layered("-wicked-coarse", 90, increments, "100", "1"));
    EXPECT_EQ(solution.summary.poses_solved, increments + 1);
    for (const PathEvent& e : solution.events) {
      ASSERT_FALSE(e.coordinates.empty());
      EXPECT_LT(std::abs(e.coordinates[0][2]), 0.5) << e.what;
    }
    const auto snapped = std::count_if(solution.events.begin(), solution.events.end(),
                                       [](const PathEvent& e) { return e.kind == PathEvent::Kind::snapped; });
    EXPECT_EQ(snapped, 2) << increments;
    for (std::size_t row = 0; row < solution.poses.rows(); ++row)
      if (std::abs(solution.poses.number(row, "knee.flexion_deg") - 36) < 1e-6)
        rotations.push_back(solution.poses.number(row, "knee.rotation_deg"));
  }
  ASSERT_EQ(rotations.size(), 4u);
  for (const double rotation : rotations) EXPECT_NEAR(rotation, rotations[0], 1e-8);
}

/// But for the heaviest load on the softest layer, which dislocates the knee at 47 deg: it says so.
TEST(LayeredKnee, LightAndHeavyLoadsSoftAndStiff) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart.stl");
  for (const char* load : {"100", "500", "1000"})
    for (const char* modulus : {"1", "10", "100", "1000"}) {
      if (std::string(load) == "1000" && std::string(modulus) == "1") continue;
      const Solution solution = solve_text(layered("", 90, 90, load, modulus));
      EXPECT_EQ(solution.summary.poses_solved, 91) << load << " N, " << modulus << " MPa";
      for (std::size_t row = 0; row < solution.poses.rows(); ++row)
        EXPECT_LT(solution.poses.number(row, "residual"), 1e-10) << load << " N, " << modulus << " MPa, row " << row;
    }
}

}  // namespace
}  // namespace genu
