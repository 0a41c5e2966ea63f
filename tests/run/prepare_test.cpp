// From files to a model: meshes where the scene puts them, errors where the scene named the file, warnings kept.
#include "genu/run/prepare.h"

#include <gtest/gtest.h>

#include "genu/geometry/analytic.h"
#include "genu/geometry/stl_writer.h"
#include "run/scenes.h"

namespace genu {
namespace {

/// A scene with one meshed surface; `more` are further keys of it.
std::string scene_text(const std::string& more) {
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
    const auto p = prepare(folder.write("scene.toml", scene_text("origin = [1, 2, 3]\nx_axis = [0, 1, 0]\n"
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
  EXPECT_FALSE(prepare(folder.write("scene.toml", scene_text("")), out).has_value());
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
  EXPECT_FALSE(prepare(folder.write("scene.toml", scene_text("degree = 3\n  fit_radius = 0.2\n")), out).has_value());
  ASSERT_EQ(out.items().size(), 1u) << test::messages(out);
  EXPECT_EQ(out.items()[0].key, "surface.lump.fit_radius");
  EXPECT_EQ(out.items()[0].line, 18);
  EXPECT_EQ(out.items()[0].column, 16);
}

TEST(Prepare, KeepsWarningsOfAMeshThatCanBeUsed) {
  const test::TemporaryFolder folder;
  write_lump(folder, Vec3(1e-3, 9e-4, 8e-4), 1e-4);  // 3 mm across: small for a knee, not refused
  Diagnostics out;
  const auto p = prepare(folder.write("scene.toml", scene_text("")), out);
  ASSERT_TRUE(p.has_value()) << test::messages(out);
  ASSERT_EQ(out.items().size(), 1u) << test::messages(out);
  EXPECT_EQ(out.items()[0].severity, Diagnostic::Severity::warning);
  EXPECT_EQ(out.items()[0].line, 15);
  ASSERT_TRUE(p->notes.at(0).mesh.has_value());
}

}  // namespace
}  // namespace genu
