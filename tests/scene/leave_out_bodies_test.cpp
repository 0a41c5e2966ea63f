// Bodies that are left out, with all that is on them.
#include "genu/scene/leave_out_bodies.h"

#include "scene/scene_text.h"

namespace genu::scene_test {
namespace {

/// A second moving body between the two, with one of everything that a scene can have on it, listed before the rest.
std::string with_meniscus(const std::string& more = {}) {
  std::string text = edited("[body.femur]", "[body.meniscus]\n" + more + "[body.femur]");
  text = edited("[joint.knee]", R"([joint.slide]
type = "free"
parent = "tibia"
child = "meniscus"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
reference = { z = 8 }
[joint.knee])",
                text);
  text = edited("[surface.ball]", R"([surface.wedge]
body = "meniscus"
shape = "sphere"
radius = 5
[surface.ball])",
                text);
  text = edited("[contact.medial]", R"([contact.wedge_floor]
surfaces = ["wedge", "floor"]
model = "rigid"
[contact.medial])",
                text);
  text = edited("[ligament.AAC]", R"([compartment.inside]
direct = ["medial"]
meniscal = ["wedge_floor"]
[ligament.horn]
from = { body = "meniscus", point = [0, 10, 0] }
to = { body = "tibia", point = [0, 20, 0] }
law = "quadratic"
stiffness = 100
reference_strain = 0
[bundle.all]
fibres = ["*"]
[bushing.pad]
from = { body = "tibia" }
to = { body = "meniscus" }
stiffness = [1, 1, 1]
[ligament.AAC])",
                text);
  text = edited("[load.push]", "[load.nudge]\nbody = \"meniscus\"\nforce = [1, 0, 0]\n[load.push]", text);
  return edited("load = { push = [0, 1] }", "load = { nudge = [0, 1], push = [0, 1] }",
                edited("\"knee.flexion\" = [0, 70]", "\"slide.x\" = 0, \"knee.flexion\" = [0, 70]", text));
}

TEST(LeaveOutBodies, TakesAllThatIsOnThem) {
  const Scene whole = good(with_meniscus());
  ASSERT_EQ(whole.bodies.size(), 3u);
  ASSERT_EQ(whole.bundles.at(0).members.size(), 2u);
  const Scene scene = good(with_meniscus("enabled = false\n")), never = good(kGoodScene);
  EXPECT_EQ(scene.bodies.size(), 2u);
  EXPECT_EQ(scene.joints.size(), 1u);
  EXPECT_EQ(scene.surfaces.size(), 2u);
  EXPECT_EQ(scene.contacts.size(), 1u);
  EXPECT_EQ(scene.ligaments.size(), 1u);
  EXPECT_TRUE(scene.bushings.empty());
  EXPECT_EQ(scene.loads.size(), 1u);
  EXPECT_TRUE(scene.compartments.at(0).meniscal.empty());
  EXPECT_EQ(scene.compartments.at(0).direct.size(), 1u);
  // All references are those of the scene that never had it.
  EXPECT_EQ(scene.joints[0].child, never.joints[0].child);
  EXPECT_EQ(scene.surfaces[0].body, never.surfaces[0].body);
  EXPECT_EQ(scene.contacts[0], [&] {
    ContactDef c = never.contacts[0];
    c.where = scene.contacts[0].where;
    return c;
  }());
  EXPECT_EQ(scene.ligaments[0].from.body, never.ligaments[0].from.body);
  EXPECT_EQ(scene.bundles.at(0).members, std::vector<int>{0});
  EXPECT_EQ(scene.loads[0].body, never.loads[0].body);
  ASSERT_EQ(scene.steps[0].prescribe.size(), 1u);
  EXPECT_EQ(scene.steps[0].prescribe[0].coordinate, never.steps[0].prescribe[0].coordinate);
  ASSERT_EQ(scene.steps[0].factors.size(), 1u);
  EXPECT_EQ(scene.steps[0].factors[0].load, 0);
}

TEST(LeaveOutBodies, ADrivenCoordinateKeepsALoadThatHoldsIt) {
  const auto driven = [](const std::string& drive) {
    std::string text = edited("load = { nudge = [0, 1], push = [0, 1] }",
                              "drive = { \"knee.flexion\" = " + drive + " }", with_meniscus("enabled = false\n"));
    return edited("[body.meniscus]", "[body.@meniscus]", text);
  };
  expect_one_error(driven("\"nudge\""), "body.meniscus.enabled", "false", "takes all loads that drive knee.flexion");
  const Scene scene = good(unmarked(driven("[\"nudge\", \"push\"]")).text);
  ASSERT_EQ(scene.steps[0].prescribe.size(), 1u);
  EXPECT_EQ(scene.steps[0].prescribe[0].drivers, std::vector<int>{0}) << "push";
}

TEST(LeaveOutBodies, WhatCannotGo) {
  expect_refused("[body.tibia]\n", "[body.@tibia]\nenabled = false\n", "body.tibia.enabled", "false", "is fixed");
  expect_refused("[body.femur]\n", "[body.@femur]\nenabled = false\n", "body.femur.enabled", "false",
                 "is the last body that moves");
  std::string carried = with_meniscus("enabled = false\n");
  carried = edited("parent = \"tibia\"\nchild = \"femur\"", "parent = \"meniscus\"\nchild = \"femur\"", carried);
  carried = edited("[body.meniscus]", "[body.@meniscus]", carried);
  expect_one_error(carried, "body.meniscus.enabled", "false", "carries femur by knee: leave that out too");
}

}  // namespace
}  // namespace genu::scene_test
