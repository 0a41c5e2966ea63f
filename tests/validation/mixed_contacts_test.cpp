// Rigid contacts and elastic layers in one joint: against sums by hand, and the rigid knee as the limit of a stiff
// layer.
#include <cmath>

#include <gtest/gtest.h>

#include "genu/contact/layer_law.h"
#include "genu/study/evaluate.h"
#include "support/judged.h"
#include "support/knee_scene.h"
#include "support/places.h"
#include "support/scene_model.h"
#include "support/scenes.h"

namespace genu {
namespace {

std::string soft(const std::string& modulus, const std::string& more = "") {
  return "model = \"cartilage\"\nmodulus = " + modulus + "\npoisson = 0.4\nthickness = 4\n" + more;
}

/// Replaces the model of one contact.
std::string with_model(const std::string& text, const std::string& contact, const std::string& model) {
  const std::size_t at = text.find("[contact." + contact + "]"), line = text.find("model = \"rigid\"", at);
  EXPECT_NE(at, std::string::npos);
  return text.substr(0, line) + model + text.substr(line + std::string("model = \"rigid\"").size());
}

/// A ball of 20 mm on a soft plate and against a rigid wall, pulled by a spring.
TEST(MixedContacts, ABallBetweenASoftPlateAndARigidWall) {
  const std::string text =
      test::replaced(test::bone_on_ground("{ z = 20 }"), "angle = \"rad\"", "angle = \"deg\"") +
      test::surface("plate", "ground", "plane") + test::surface("ball", "bone", "sphere", "radius = 20") +
      test::surface("wall", "ground", "plane", "origin = [-20.05, 0, 0]\nz_axis = [1, 0, 0]") +
      test::layer("below", "plate", "ball") + test::contact("beside", "wall", "ball") +
      test::spring("s", "[0, 0, 0]", "[0, 0, 30]", 0.5, 0) +
      "[load.push]\nbody = \"bone\"\nforce = [-5, 0, -50]\n[[step]]\nprescribe = { \"j.a\" = 0, \"j.b\" = 0, \"j.c\" = "
      "0, \"j.y\" = 0 }\nload = { push = [0.2, 1] }\nincrements = 4\n";
  const ResultTable poses = test::table_of(text);
  ASSERT_EQ(poses.rows(), 5u);
  for (std::size_t row = 0; row < poses.rows(); ++row) {
    const double factor = 0.2 * (1 + static_cast<double>(row)), z = poses.number(row, "j.z_mm");
    EXPECT_NEAR(poses.number(row, "j.x_mm"), -0.05, 1e-12);
    EXPECT_NEAR(poses.number(row, "beside.force_N"), 5 * factor - 0.5 * 0.05, 1e-9);
    EXPECT_NEAR(poses.number(row, "below.force_z_N"), 50 * factor - 0.5 * (30 - z), 1e-9);
    // Half of the sum of both castings: see SmoothLayer.SphereOnPlaneIsTheMeanOfBothCastings.
    const double K = confined_modulus(5e6, 0.4) / 4e-3, d = 1e-3 * (20 - z);
    EXPECT_NEAR(poses.number(row, "below.force_N"), M_PI * K * d * d * (20e-3 - d / 6), 2e-3 * 50 * factor) << row;
  }
}

/// One compartment soft, the other rigid: what the pose of the run lacks without its rigid contact is the force along
/// the normal there that the run has given.
TEST(MixedContacts, AKneeWithOneSoftCompartment) {
  for (const std::string soft_side : {"medial", "lateral"}) {
    const std::string rigid_side = soft_side == "medial" ? "lateral" : "medial";
    const std::string original = test::read_text(genu::test::source_folder() + "/meshes/lenhart_polynomial/scene.toml");
    const std::string text = with_model(original.substr(0, original.find("[[step]]")), soft_side, soft("5")) +
                             "[[step]]\nprescribe = { \"knee.flexion\" = [0, 60] }\nincrements = 12\n";
    const test::TemporaryFolder folder;
    const std::string scene = folder.write("scene.toml", text);
    Diagnostics out;
    Solution run;
    ASSERT_EQ(run_scene(scene, folder / "run", {}, out, &run), kExitOk) << test::messages(out);
    test::expect_judged_ok(scene, run.poses);
    Evaluation given;
    ASSERT_EQ(evaluate_scene(scene, folder / "run/results.csv", folder / "given", {}, out, &given), kExitOk)
        << test::messages(out);
    const ResultTable& poses = run.poses;
    for (std::size_t row = 0; row < poses.rows(); ++row) {
      double rigid = 0;
      for (int k = 1; poses.has_column(rigid_side + "." + std::to_string(k) + ".force_N"); ++k)
        if (const double f = poses.number(row, rigid_side + "." + std::to_string(k) + ".force_N"); f > 0) rigid += f;
      if (rigid == 0) rigid = poses.number(row, rigid_side + ".force_N");
      Vec3 missing;
      const char* axes[] = {"x", "y", "z"};
      for (int i = 0; i < 3; ++i)
        missing[i] = given.poses.number(row, std::string("tibia.residual_force_") + axes[i] + "_N");
      EXPECT_NEAR(missing.norm(), rigid, 0.02 * rigid) << soft_side << " soft, row " << row;
      EXPECT_GT(rigid, 10);
      EXPECT_GT(poses.number(row, soft_side + ".force_N"), 10);
    }
  }
}

/// A layer between bodies of which one hangs on a hinge: its moment about the axis balances the load's.
TEST(MixedContacts, ALayerUnderALeverOnAHinge) {
  const std::string text = R"(format = 1
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
[body.lever]
[joint.hinge]
type = "revolute"
parent = "ground"
child = "lever"
axis = [0, 1, 0]
[surface.plate]
body = "ground"
shape = "plane"
origin = [0, 0, -20]
[surface.ball]
body = "lever"
shape = "sphere"
origin = [60, 0, 0]
radius = 20
[load.push]
body = "lever"
force = [0, 0, -30]
point = [100, 0, 0]
[contact.under]
surfaces = ["plate", "ball"]
)" + soft("5") + "\n[[step]]\nload = { push = [0.2, 1] }\nincrements = 4\n";
  const ResultTable poses = test::table_of(text);
  ASSERT_EQ(poses.rows(), 5u);
  for (std::size_t row = 0; row < poses.rows(); ++row) {
    const double factor = 0.2 * (1 + static_cast<double>(row)),
                 angle = poses.number(row, "hinge.angle_deg") * M_PI / 180;
    // Positive about y lowers the tip; on the ball the layer pushes with `force` at its centre of pressure.
    const Vec3 tip = 0.1 * Vec3(std::cos(angle), 0, -std::sin(angle));
    const Vec3 on_lever = -factor * 30 * Vec3::UnitZ();
    Vec3 force, moment;
    const char* axes[] = {"x", "y", "z"};
    for (int i = 0; i < 3; ++i) {
      force[i] = poses.number(row, std::string("under.force_") + axes[i] + "_N");
      moment[i] = poses.number(row, std::string("under.moment_") + axes[i] + "_Nm");
    }
    const Mat3 R =
        exp_rotation({0, angle, 0});  // force and moment are in the lever's axes, about its origin: the hinge
    EXPECT_NEAR((R * moment).y() + tip.cross(on_lever).y(), 0, 1e-9) << row;
    EXPECT_NEAR(force.norm(), factor * 30 * 100 / 60, 0.02 * factor * 50) << row;
  }
}

/// The more rigid the layer, the nearer the pose is to the rigid one: with force ~ K depth^2 by the root of 10 a
/// decade.
TEST(MixedContacts, TheRigidKneeIsTheLimitOfAStiffLayer) {
  const std::string original = test::read_text(test::dortmans_file());
  const std::string step =
      "[plausible]\npressure = 1e6\n[[step]]\nprescribe = { \"knee.flexion\" = [0, 40] }\nincrements = 4\n";
  const std::string text = original.substr(0, original.find("[[step]]"));
  const ResultTable rigid = test::table_of(text + step);
  double before = 0;
  for (const char* modulus : {"10", "100", "1000", "10000"}) {
    const std::string layers = with_model(with_model(text, "medial", soft(modulus)), "lateral", soft(modulus));
    const double off = test::worst_difference(test::table_of(layers + step), rigid, "knee.z_mm");
    std::printf("%s MPa: %.4g mm from rigid\n", modulus, off);
    if (before > 0) {
      EXPECT_GT(before / off, 2.5) << modulus;
      EXPECT_LT(before / off, 4) << modulus;
    }
    before = off;
  }
}

TEST(MixedContacts, TheMeasuredRigidKneeIsTheLimitToo) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart-medium.stl");
  const std::string text = test::lenhart_scene("-medium", 20, 40, 4);
  const test::TemporaryFolder folder;
  const auto table = [&](const std::string& scene) {
    Diagnostics out;
    Solution solution;
    EXPECT_EQ(run_scene(folder.write("scene.toml", scene), folder / "out", {}, out, &solution), kExitOk)
        << test::messages(out);
    test::expect_judged_ok(folder / "scene.toml", solution.poses);
    return solution.poses;
  };
  const ResultTable rigid = table(text);
  double before = 0;
  for (const char* modulus : {"10", "100", "1000"}) {
    const double off = test::worst_difference(
        table(with_model(text, "tibiofemoral", soft(modulus, "quadrature = \"smooth\"\n"))), rigid, "knee.y_mm");
    std::printf("%s MPa: %.4g mm from rigid\n", modulus, off);
    if (before > 0) {
      EXPECT_GT(before / off, 2) << modulus;
      EXPECT_LT(before / off, 4.5) << modulus;
    }
    before = off;
  }
}

/// From 5 mm inside each other (more is refused) and from 5 mm apart the knee comes to the same pose, soft and rigid.
TEST(MixedContacts, StartsFromFiveMillimetresOfOverlap) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart-medium.stl");
  const test::TemporaryFolder folder;
  const std::string rigid = test::lenhart_scene("-medium", 20, 25, 1),
                    smooth = with_model(rigid, "tibiofemoral", soft("10", "quadrature = \"smooth\"\n")),
                    triangles = with_model(rigid, "tibiofemoral",
                                           soft("10", "quadrature = \"triangles\"\ncast_from = \"tibia_cartilage\"\n"));
  for (const std::string& text : {rigid, smooth, triangles}) {
    const auto table = [&](const std::string& start) {
      const std::string translations = "translations = [\"x\", \"y\", \"z\"]";
      Diagnostics out;
      Solution solution;
      EXPECT_EQ(run_scene(folder.write("scene.toml", test::replaced(text, translations, translations + start)),
                          folder / "out", {}, out, &solution),
                kExitOk)
          << start << test::messages(out);
      return solution.poses;
    };
    const ResultTable usual = table("");
    // The tibia is pushed up into the femur, and let down from it.
    for (const char* start : {"\nstart = { y = 5 }", "\nstart = { y = -5 }"}) {
      const ResultTable other = table(start);
      EXPECT_LT(test::worst_difference(other, usual, "knee.y_mm"), 1e-4) << start;
      EXPECT_LT(test::worst_difference(other, usual, "knee.rotation_deg"), 1e-3) << start;
    }
  }
}

}  // namespace
}  // namespace genu
