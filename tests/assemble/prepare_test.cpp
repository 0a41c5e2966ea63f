// From files to a model: meshes where the scene puts them, errors where the scene named the file, warnings kept.
#include "genu/assemble/prepare.h"

#include <gtest/gtest.h>

#include "genu/mesh_files/stl_writer.h"
#include "genu/surface/analytic.h"
#include "support/judged.h"
#include "support/scene_model.h"
#include "support/scenes.h"

namespace genu {
namespace {

/// A scene with one meshed surface; `more` are further keys of it.
std::string scene_of_lump(const std::string& more) {
  return "format = 1\nunits = { length = \"mm\", angle = \"deg\" }\n[body.ground]\nfixed = true\n[body.bone]\n"
         "[joint.j]\ntype = \"free\"\nparent = \"ground\"\nchild = \"bone\"\nrotations = [\"a x\", \"b y\", \"c z\"]\n"
         "translations = [\"x\", \"y\", \"z\"]\n[surface.lump]\nbody = \"bone\"\nshape = \"mesh\"\n"
         "file = \"lump.stl\"\nunits = \"mm\"\n" +
         more + "[[step]]\nincrements = 1\n";
}

void write_lump(const test::TemporaryFolder& folder, const Vec3& radii, double edge) {
  const auto lump = make_ellipsoid({}, radii, false);
  EXPECT_EQ(write_stl(lump->triangles(edge, Vec3::Zero(), 0.1), folder / "lump.stl", 1e-3, "lump"), "");
}

TEST(Prepare, PutsAMeshWhereItsAxesSayAndTurnsItInsideOut) {
  const test::TemporaryFolder folder;
  const Vec3 radii(0.02, 0.014, 0.01);
  write_lump(folder, radii, 1.5e-3);
  for (const bool inside : {false, true}) {
    Diagnostics out;
    const auto p = prepare(folder.write("scene.toml", scene_of_lump("origin = [1, 2, 3]\nx_axis = [0, 1, 0]\n"
                                                                    "z_axis = [1, 0, 0]\ninside = " +
                                                                    std::string(inside ? "true\n" : "false\n"))),
                           out);
    ASSERT_TRUE(p.has_value()) << test::messages(out);
    // x of the mesh is the body's y, its z the body's x, and so its y the body's z.
    const Vec3 axes[] = {Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};
    for (int k = 0; k < 3; ++k) {
      const Vec3 tip = Vec3(1e-3, 2e-3, 3e-3) + radii[k] * axes[k];
      SurfacePoint s;
      ASSERT_TRUE(p->surfaces[0]->project(tip, s)) << k;
      EXPECT_LT((s.p - tip).norm(), 5e-5) << k;
      EXPECT_GT((inside ? -1 : 1) * s.n.dot(axes[k]), 0.999) << k;
    }
  }
}

TEST(Prepare, ErrorsOfAMeshFileStandWhereTheSceneNamesIt) {
  const test::TemporaryFolder folder;
  Diagnostics out;
  folder.write("lump.stl", "solid cut short");
  EXPECT_FALSE(prepare(folder.write("scene.toml", scene_of_lump("")), out).has_value());
  ASSERT_EQ(out.items().size(), 1u) << test::messages(out);
  const Diagnostic& d = out.items()[0];
  EXPECT_EQ(d.file, folder / "scene.toml");
  EXPECT_EQ(d.line, 15);
  EXPECT_EQ(d.column, 8);
  EXPECT_EQ(d.key, "surface.lump.file");
  EXPECT_EQ(d.found, '"' + (folder / "lump.stl") + '"');
}

TEST(Prepare, ARadiusThatTheMeshIsTooCoarseForIsFoundAtItsKey) {
  const test::TemporaryFolder folder;
  write_lump(folder, Vec3(0.02, 0.014, 0.01), 1.5e-3);
  Diagnostics out;
  EXPECT_FALSE(prepare(folder.write("scene.toml", scene_of_lump("degree = 3\n  fit_radius = 0.2\n")), out).has_value());
  ASSERT_EQ(out.items().size(), 1u) << test::messages(out);
  EXPECT_EQ(out.items()[0].key, "surface.lump.fit_radius");
  EXPECT_EQ(out.items()[0].line, 18);
  EXPECT_EQ(out.items()[0].column, 16);
}

TEST(Prepare, KeepsWarningsOfAMeshThatCanBeUsed) {
  const test::TemporaryFolder folder;
  write_lump(folder, Vec3(1e-3, 9e-4, 8e-4), 1e-4);  // 3 mm across: small for a knee, not refused
  Diagnostics out;
  const auto p = prepare(folder.write("scene.toml", scene_of_lump("")), out);
  ASSERT_TRUE(p.has_value()) << test::messages(out);
  ASSERT_EQ(out.items().size(), 1u) << test::messages(out);
  EXPECT_EQ(out.items()[0].severity, Diagnostic::Severity::warning);
  EXPECT_EQ(out.items()[0].line, 15);
  ASSERT_TRUE(p->notes.at(0).mesh.has_value());
}

TEST(Prepare, TwoPlanesNeedALayerAndAnEnd) {
  const std::string bounded = "patch = { x = [-10, 10], y = [-8, 8] }", strip = "patch = { x = [-10, 10] }";
  const auto refusals = [](const std::string& upper, const std::string& lower, bool rigid) {
    const test::TemporaryFolder folder;
    Diagnostics out;
    const auto ignored = prepare(
        folder.write("scene.toml",
                     test::bone_on_ground() + test::surface("upper", "bone", "plane", "inside = true\n" + upper) +
                         test::surface("lower", "ground", "plane", lower) +
                         (rigid ? test::contact("c", "upper", "lower") : test::layer("c", "upper", "lower")) +
                         test::step("")),
        out);
    return test::messages(out);
  };
  EXPECT_NE(refusals(bounded, "", true).find("contact.c.surfaces: two planes never touch at a point"),
            std::string::npos);
  for (const auto& [upper, lower] : {std::pair{std::string(), std::string()}, {strip, ""}, {strip, strip}}) {
    const std::string said = refusals(upper, lower, false);
    EXPECT_NE(said.find("contact.c.surfaces: two planes without end"), std::string::npos) << said;
  }
  for (const auto& [upper, lower] : {std::pair{bounded, std::string()}, {std::string(), bounded}, {bounded, bounded}})
    EXPECT_EQ(refusals(upper, lower, false), "");
}

/// A plate of 20 x 16 mm on a layer sinks evenly: F = A K d / h, and stands straight.
TEST(Prepare, APlateOnALayerStandsAsFarIn) {
  constexpr double kArea = 20e-3 * 16e-3, kForce = 100, kThickness = 4e-3, kConfined = 5e6 * 0.6 / (1.4 * 0.2);
  for (const std::string quadrature : {"", "quadrature = \"triangles\"\ncast_from = \"upper\""}) {
    const test::TemporaryFolder folder;
    Diagnostics out;
    Solution solution;
    const std::string scene = folder.write(
        "scene.toml",
        test::bone_on_ground("{ z = -0.05 }") +
            test::surface("upper", "bone", "plane", "inside = true\npatch = { x = [-10.3, 9.7], y = [-8.2, 7.8] }") +
            test::surface("lower", "ground", "plane", "patch = { x = [-40, 40], y = [-40, 40] }") +
            test::layer("c", "upper", "lower", quadrature) +
            test::load("press", "force = [0, 0, -100]\npoint = [-0.3, -0.2, 0]") +
            test::step("prescribe = { \"j.c\" = 0, \"j.x\" = 0, \"j.y\" = 0 }\nincrements = 1"));
    ASSERT_EQ(test::judged_run(scene, folder / "out", {}, out, &solution), kExitOk)
        << test::messages(out) << (solution.summary.verdict.empty() ? "" : solution.summary.verdict.back());
    const double depth = kForce * kThickness / (kArea * kConfined);
    const Pose& plate = solution.records.back().point.pose.state.poses[1];
    EXPECT_NEAR(-plate.p.z() / depth, 1, quadrature.empty() ? 1e-2 : 1e-6) << quadrature;
    EXPECT_LT((plate.R - Mat3::Identity()).norm(), 1e-3) << quadrature;
  }
}

/// A disc thinner than the places where it is looked at: told once, and only of bodies (a socket has no thickness).
TEST(Prepare, WarnsOfABodyThinnerThanItsSamples) {
  const auto warnings = [](double thick, const std::string& more) {
    const test::TemporaryFolder folder;
    const std::string radii = "radii = [10, 10, " + std::to_string(0.5 * thick) + "]\n";
    const std::string scene =
        test::bone_on_ground("{ z = 30 }") + test::surface("disc", "bone", "ellipsoid", radii + more) +
        test::surface("ball", "ground", "sphere", "radius = 12\n") +
        test::surface("other", "ground", "sphere", "radius = 12\norigin = [30, 0, 0]\n") +
        test::contact("c", "disc", "ball") + test::contact("d", "disc", "other") + test::step("increments = 1");
    Diagnostics out;
    EXPECT_TRUE(prepare(folder.write("scene.toml", scene), out).has_value()) << test::messages(out);
    std::size_t told = 0;
    for (const Diagnostic& d : out.items()) {
      if (d.rule.find("surfaces are looked at every") == std::string::npos) continue;
      EXPECT_EQ(d.key, "surface.disc");
      EXPECT_GT(d.line, 0);
      ++told;
    }
    return told;
  };
  EXPECT_EQ(warnings(0.01, ""), 1U);
  EXPECT_EQ(warnings(1, ""), 0U);
  EXPECT_EQ(warnings(0.01, "inside = true\n"), 0U);
}

/// Terms in another unit than the file's make a wall of a condyle, for which no memory is enough.
TEST(Prepare, APolynomialLargerThanAJointIsRefusedWithItsPlace) {
  const test::TemporaryFolder folder;
  for (const std::string steep : {"1e3", "1e9", "1e20"}) {
    Diagnostics out;
    const auto p = prepare(folder.write("scene.toml", test::bone_on_ground() +
                                                          test::surface("wall", "bone", "polynomial",
                                                                        "chart = \"cylindrical\"\nterms = [[0, 0, 20], "
                                                                        "[2, 0, " +
                                                                            steep +
                                                                            "]]\npatch = { theta = [-2.3, 0.7], z = "
                                                                            "[-13, 13] }") +
                                                          test::step("increments = 1")),
                           out);
    EXPECT_FALSE(p.has_value()) << steep;
    EXPECT_NE(test::messages(out).find("surface.wall.patch: holds a surface of"), std::string::npos)
        << test::messages(out);
  }
}

}  // namespace
}  // namespace genu
