#include "genu/store/report_meshes.h"

#include <gtest/gtest.h>

#include "genu/store/report_limits.h"
#include "support/scenes.h"
#include "support/text.h"

namespace genu {
namespace {

/// A ball in a socket: what its surfaces look like before anything is solved.
std::vector<ReportMesh> shown(const std::string& socket, const std::vector<Vec3>& touched) {
  test::TemporaryFolder folder;
  Diagnostics out;
  const auto p = prepare(folder.write("scene.toml", R"(format = 1
units = { length = "mm", angle = "deg" }
[body.pelvis]
fixed = true
[body.femur]
[joint.hip]
type = "free"
parent = "pelvis"
child = "femur"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
[surface.head]
body = "femur"
shape = "sphere"
radius = 24
[surface.socket]
body = "pelvis"
)" + socket + R"(
[contact.hip]
surfaces = ["head", "socket"]
model = "rigid"
[[step]]
)"),
                         out);
  EXPECT_TRUE(p.has_value()) << test::messages(out);
  if (!p) return {};
  ReportRun run;
  ReportContact contact{"hip", "socket", 1, 0, touched, touched};
  run.contacts.push_back(contact);
  run.body_poses.assign(touched.size(), std::vector<Pose>(2));
  return report_meshes(*p, run, ReportLimits().triangles);
}

TEST(ReportMeshes, ASocketIsCutOpenRoundItsContactAndABallStaysWhole) {
  const auto meshes = shown("shape = \"sphere\"\nradius = 25\ninside = true", {Vec3(0, 0, 0.025)});
  ASSERT_EQ(meshes.size(), 2u);
  double lowest[2] = {1, 1};
  for (std::size_t k = 0; k < 2; ++k)
    for (const Vec3& v : meshes[k].vertices) lowest[k] = std::min(lowest[k], v.z());
  EXPECT_NEAR(lowest[0], -0.024, 1e-3);
  EXPECT_GT(lowest[1], -0.01);
}

TEST(ReportMeshes, AnEndlessSurfaceIsShownWhereItIsTouched) {
  const auto meshes = shown("shape = \"plane\"\norigin = [0, 0, -25]", {Vec3(0.3, 0, -0.025), Vec3(0.31, 0, -0.025)});
  ASSERT_EQ(meshes.size(), 2u);
  ASSERT_FALSE(meshes[1].triangles.empty());
  for (const Vec3& v : meshes[1].vertices) {
    EXPECT_NEAR(v.x(), 0.305, 0.15);
    EXPECT_NEAR(v.z(), -0.025, 1e-12);
  }
}

TEST(ReportMeshes, AHugeBallIsShownInPart) {
  const auto meshes = shown("shape = \"sphere\"\nradius = 5000\norigin = [0, 0, -5025]", {Vec3(0, 0, -0.025)});
  ASSERT_EQ(meshes.size(), 2u);
  ASSERT_FALSE(meshes[1].triangles.empty());
  for (const Vec3& v : meshes[1].vertices) EXPECT_LT(v.norm(), 12) << "a ball of 10 m would hide the other one";
}

}  // namespace
}  // namespace genu
