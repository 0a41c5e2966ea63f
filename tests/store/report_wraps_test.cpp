// A cylinder that only guides a ligament is shown where the ligament lies on it.
#include "genu/store/report_wraps.h"

#include <gtest/gtest.h>

#include "genu/store/report.h"
#include "genu/study/run_scene.h"
#include "support/judged.h"
#include "support/scenes.h"
#include "support/text.h"

namespace genu {
namespace {

/// A ball on a plate, held down by a band over a cylinder of the plate's body.
std::string ball_and_band(const std::string& more = {}) {
  return R"(format = 1
units = { length = "mm", angle = "deg" }
[body.plate]
fixed = true
[body.ball]
[joint.j]
type = "free"
parent = "plate"
child = "ball"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
reference = { z = 20 }
[surface.top]
body = "plate"
shape = "plane"
[surface.round]
body = "ball"
shape = "sphere"
radius = 20
[surface.roll]
body = "plate"
shape = "cylinder"
radius = 10
origin = [60, 0, 20]
x_axis = [1, 0, 0]
z_axis = [0, 1, 0]
[contact.c]
surfaces = ["round", "top"]
model = "rigid"
[ligament.band]
from = { body = "ball", point = [0, 0, 0] }
to = { body = "plate", point = [80, 0, 0] }
wrap = [{ surface = "roll", side = [0, 0, 1] }]
law = "spring"
stiffness = 1
slack_length = 10
[load.weight]
body = "ball"
force = [0, 0, -100]
)" + more +
         "[[step]]\nprescribe = { \"j.x\" = 0, \"j.a\" = 0, \"j.b\" = 0, \"j.c\" = 0 }\n";
}

struct Shown {
  std::optional<Prepared> prepared;
  Solution solution;
  ReportRun run;

  explicit Shown(const std::string& text) {
    const test::TemporaryFolder folder;
    Diagnostics out;
    prepared = prepare(folder.write("scene.toml", text), out);
    EXPECT_TRUE(prepared.has_value()) << test::messages(out);
    if (!prepared) return;
    ContactField field(prepared->model);
    solution = test::judged(*prepared, solve(*prepared, field, {}));
    run = report_run(*prepared, solution);
  }
  const ReportMesh& mesh(const std::string& name) const {
    for (const ReportMesh& m : run.meshes)
      if (m.name == name) return m;
    ADD_FAILURE() << "no mesh " << name;
    return run.meshes.at(0);
  }
};

TEST(ReportWraps, ARollIsShownWhereTheBandLies) {
  const Shown s(ball_and_band());
  ASSERT_TRUE(s.prepared.has_value());
  EXPECT_EQ(only_wrapped(s.prepared->scene), (std::vector<bool>{false, false, true}));
  EXPECT_EQ(s.mesh("top").kind, ReportMesh::Kind::surface);
  const ReportMesh& roll = s.mesh("roll");
  EXPECT_EQ(roll.kind, ReportMesh::Kind::wrapped);
  ASSERT_GT(roll.triangles.size(), 20u);
  double lowest = 1, highest = 0;
  for (const Vec3& v : roll.vertices) {
    EXPECT_NEAR(std::hypot(v.x() - 0.06, v.z() - 0.02), 0.01, 1e-9);
    EXPECT_LT(std::abs(v.y()), 0.009) << "a margin of 6 mm, and an edge of 2";
    lowest = std::min(lowest, v.z());
    highest = std::max(highest, v.z());
  }
  EXPECT_GT(highest, 0.0295);
  EXPECT_GT(lowest, 0.011) << "the band never comes to the roll's underside";
}

/// Cables have no course on the page, but their surfaces are shown in the same way.
TEST(ReportWraps, ACableTouchesItsRollToo) {
  std::string text = ball_and_band();
  const std::size_t at = text.find("[ligament.band]"), end = text.find("[load.weight]");
  text.replace(
      at, end - at,
      "[load.band]\nfrom = { body = \"ball\", point = [0, 0, 0] }\nto = { body = \"plate\", point = [80, 0, 0] }\n"
      "wrap = [{ surface = \"roll\", side = [0, 0, 1] }]\nmagnitude = 5\n");
  const Shown s(text);
  ASSERT_TRUE(s.prepared.has_value());
  EXPECT_TRUE(s.run.wrapped.empty());
  EXPECT_EQ(s.run.cables.size(), 1u);
  EXPECT_EQ(s.mesh("roll").kind, ReportMesh::Kind::wrapped);
  for (const Vec3& v : s.mesh("roll").vertices) EXPECT_LT(std::abs(v.y()), 0.009);
}

TEST(ReportWraps, WhatIsInContactOrAllThereIsOfABodyIsASurface) {
  std::string text = ball_and_band(
      "[surface.pad]\nbody = \"ball\"\nshape = \"sphere\"\nradius = 1\norigin = [0, 0, 60]\n"
      "[contact.d]\nsurfaces = [\"pad\", \"roll\"]\nmodel = \"rigid\"\n");
  const std::string turned = ", \"j.c\" = 0";  // two contacts leave room for three prescribed coordinates
  text.erase(text.find(turned), turned.size());
  Diagnostics out;
  const test::TemporaryFolder folder;
  const auto p = prepare(folder.write("scene.toml", text), out);
  ASSERT_TRUE(p.has_value()) << test::messages(out);
  EXPECT_FALSE(only_wrapped(p->scene)[2]) << "in contact";
  PlacedScene alone = p->scene;
  alone.contacts.clear();
  EXPECT_TRUE(only_wrapped(alone)[2]);
  alone.surfaces[2].body = 0;
  alone.surfaces[0].body = 1;  // the plate has nothing but the roll
  EXPECT_FALSE(only_wrapped(alone)[2]);
}

TEST(ReportWraps, TrianglesNearPlaces) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}, {9, 8, 9}, {8, 9, 9}};
  mesh.triangles = {{3, 4, 5}, {0, 1, 2}};
  keep_near_places(mesh, {Vec3(-0.4, 0, 0), Vec3(5, 5, 5)}, 0.5);
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.vertices.size(), 3u);
  EXPECT_EQ(mesh.vertices[static_cast<std::size_t>(mesh.triangles[0][0])], Vec3(0, 0, 0));
}

}  // namespace
}  // namespace genu
