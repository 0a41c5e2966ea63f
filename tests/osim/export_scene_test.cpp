#include "genu/osim/export_scene.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/osim/import_scene.h"
#include "genu/scene/reader.h"
#include "osim/osim_support.h"

namespace genu::test {
namespace {

Scene scene_of(const std::string& text) {
  Diagnostics out;
  auto scene = parse_scene(text, source_folder() + "/tests/osim/scene.toml", out);
  EXPECT_FALSE(out.has_errors()) << to_string(out.items().front());
  return scene.value_or(Scene());
}

/// The scene of a model, its joints at their defaults.
Scene imported(const osim::Model& model, const std::vector<std::string>& joints,
               const std::map<std::string, double>& tensions = {}) {
  Diagnostics out;
  const auto skeleton = osim::Skeleton::build(model, joints, {}, out);
  EXPECT_FALSE(out.has_errors()) << to_string(out.items().front());
  osim::SceneRequest request;
  request.tensions = tensions;
  for (const char* file : {"condyle", "condyle-bone", "plateau", "condyle_bone"})
    request.meshes[std::string(file) + ".obj"] = "model/Geometry/plateau.obj";
  return scene_of(osim::import_scene(model, *skeleton, request).text);
}

/// As study/export_model.h asks for it: slack lengths are given in these scenes.
osim::ExportRequest request_for(const Scene& scene) {
  osim::ExportRequest request;
  request.name = scene.title;
  for (int j = 0; at(j) < scene.joints.size(); ++j)
    for (int i = 0; i < 6; ++i)
      if (scene.joints[at(j)].leaves(i))
        request.coordinates.push_back({{j, i}, scene.joints[at(j)].name + "_c" + std::to_string(i)});
  for (const LigamentDef& l : scene.ligaments) request.slack_lengths.push_back(l.rest_value);
  for (const LayerDef& l : scene.layers) request.search_depths.push_back(l.search_depth);
  for (const SurfaceDef& s : scene.surfaces) {
    const bool mesh = s.shape == SurfaceDef::Shape::mesh;
    request.meshes.push_back(mesh ? s.name + ".obj" : std::string());
    request.bones.push_back(mesh && s.thickness && s.thickness->measured ? s.name + "_bone.obj" : std::string());
  }
  return request;
}

osim::ExportedModel exported(const Scene& scene) { return osim::export_scene(scene, request_for(scene)); }

template <typename T>
const T& named(const std::vector<T>& all, const std::string& name) {
  for (const T& one : all)
    if (one.name == name) return one;
  ADD_FAILURE() << "no " << name;
  static const T none;
  return none;
}

void expect_same_point(const PathEnd& a, const PathEnd& b) {
  EXPECT_EQ(a.body, b.body);
  EXPECT_LT((a.point - b.point).norm(), 1e-14);
}

void expect_same_path(const LigamentDef& a, const LigamentDef& b) {
  expect_same_point(a.from, b.from);
  expect_same_point(a.to, b.to);
  ASSERT_EQ(a.via.size(), b.via.size());
  for (std::size_t k = 0; k < a.via.size(); ++k) expect_same_point(a.via[k], b.via[k]);
  ASSERT_EQ(a.wraps.size(), b.wraps.size());
  for (std::size_t k = 0; k < a.wraps.size(); ++k) {
    EXPECT_EQ(a.wraps[k].after, b.wraps[k].after);
    EXPECT_EQ(a.wraps[k].side.has_value(), b.wraps[k].side.has_value());
  }
}

TEST(ExportScene, ComesBackAsItWas) {
  const Scene first = imported(leg(), {"knee_r"}, {{"gastrocnemius", 80}});
  const osim::ExportedModel model = exported(first);
  EXPECT_EQ(model.left_out, 0u) << model.table;
  const Scene second = imported(model_of(model.text), {"knee_r"}, {{"gastrocnemius", 80}});
  ASSERT_EQ(second.bodies.size(), first.bodies.size());
  for (std::size_t b = 0; b < first.bodies.size(); ++b) {
    EXPECT_EQ(second.bodies[b].name, first.bodies[b].name);
    EXPECT_NEAR(second.bodies[b].mass, first.bodies[b].mass, 1e-12);
  }
  ASSERT_EQ(second.joints.size(), 1u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(second.joints[0].rotations[i].axis, first.joints[0].rotations[i].axis) << i;
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(second.joints[0].reference[i], first.joints[0].reference[i], 1e-12) << i;
  ASSERT_EQ(second.ligaments.size(), first.ligaments.size());
  for (const LigamentDef& l : first.ligaments) {
    const LigamentDef& again = named(second.ligaments, l.name);
    EXPECT_EQ(again.law, l.law);
    for (const auto& number : l.numbers) EXPECT_NEAR(again.number(number.key), number.value, 1e-9 * number.value);
    EXPECT_NEAR(again.rest_value, l.rest_value, 1e-14);
    expect_same_path(l, again);
  }
  ASSERT_EQ(second.layers.size(), 1u);
  EXPECT_NEAR(second.layers[0].modulus, first.layers[0].modulus, 1e-6);
  EXPECT_EQ(second.layers[0].poisson, first.layers[0].poisson);
  EXPECT_NEAR(second.layers[0].thickness, first.layers[0].thickness, 1e-14);
  EXPECT_NEAR(second.layers[0].search_depth, first.layers[0].search_depth, 1e-14);
  EXPECT_EQ(second.layers[0].law, first.layers[0].law);
  const LoadDef &calf = named(second.loads, "gastrocnemius"), &spring = named(second.loads, "varus_spring");
  EXPECT_EQ(calf.value, 80);
  EXPECT_LT((*calf.wraps.at(0).side - Vec3(-1, 0, 0)).norm(), 1e-12);
  EXPECT_NEAR(spring.scale->gain, named(first.loads, "varus_spring").scale->gain, 1e-9);
  EXPECT_LT((*second.gravity - *first.gravity).norm(), 1e-12);
}

TEST(ExportScene, KeepsWrapObjectsInTheirPlace) {
  const Scene first = imported(leg(), {"knee_r"});
  const Scene second = imported(model_of(exported(first).text), {"knee_r"});
  for (const char* name : {"medial_edge", "condyles"}) {
    const SurfaceDef &a = named(first.surfaces, name), &b = named(second.surfaces, name);
    EXPECT_EQ(a.body, b.body);
    EXPECT_EQ(a.shape, b.shape);
    EXPECT_EQ(a.radius, b.radius);
    EXPECT_LT((a.radii - b.radii).norm(), 1e-15);
    EXPECT_LT((a.placement.p - b.placement.p).norm(), 1e-14);
    EXPECT_LT((a.placement.R - b.placement.R).norm(), 1e-11) << name;
  }
}

constexpr const char* kTwoBones = R"(format = 1
title = "a < b & \"c\""
units = { length = "mm", angle = "deg" }
[body.femur]
fixed = true
[body.tibia]
[body.patella]
[joint.knee]
type = "revolute"
parent = "femur"
child = "tibia"
origin = [1, 2, 3]
axis = [0, 0.6, -0.8]
stiffness = 0.5
reference = { angle = 10 }
[joint.pf]
type = "fixed"
parent = "tibia"
child = "patella"
origin = [40, 5, 0]
[surface.ball]
body = "femur"
shape = "sphere"
radius = 10
[surface.floor]
body = "tibia"
shape = "plane"
[contact.tf]
surfaces = ["ball", "floor"]
model = "cartilage"
modulus = 5
poisson = 0.45
thickness = 4
[ligament.cord]
from = { body = "femur", point = [0, 30, 0] }
to = { body = "patella", point = [0, -30, 5] }
wrap = [{ surface = "ball", side = [3, 0, 4] }]
law = "linear"
stiffness = 1000
slack_length = 50
[ligament.curve]
from = { body = "femur", point = [0, 30, 0] }
to = { body = "tibia", point = [0, -30, 5] }
law = "quadratic"
stiffness = 1000
slack_length = 50
[load.push]
body = "tibia"
force = [0, 1, 0]
[[step]]
increments = 1
)";

TEST(ExportScene, RevoluteAndFixedJointsAndASideOfASphere) {
  const Scene first = scene_of(kTwoBones);
  const osim::ExportedModel model = exported(first);
  EXPECT_EQ(model.joints, std::vector<std::string>{"knee"});
  const Scene second = imported(model_of(model.text), {"knee"});
  ASSERT_EQ(second.joints.size(), 1u);
  EXPECT_EQ(second.joints[0].type, JointDef::Type::revolute);
  EXPECT_LT((second.joints[0].rotations[0].axis - Vec3(0, 0.6, -0.8)).norm(), 1e-12);
  EXPECT_NEAR(second.joints[0].reference[4], 2e-3, 1e-15);
  EXPECT_NEAR(second.joints[0].reference[0], 10 * M_PI / 180, 1e-12);
  ASSERT_EQ(second.bodies.size(), 2u);  // the patella is part of the tibia
  const LigamentDef& cord = named(second.ligaments, "cord");
  EXPECT_LT((cord.to.point - Vec3(0.04, -0.025, 0.005)).norm(), 1e-14);
  EXPECT_LT((*cord.wraps.at(0).side - Vec3(0.6, 0, 0.8)).norm(), 1e-12);
  EXPECT_NEAR(named(second.loads, "knee_stiffness").scale->gain, 0.5 * 180 / M_PI, 1e-9);
}

TEST(ExportScene, SaysThatABushingIsLeftOut) {
  const osim::ExportedModel model = exported(
      scene_of(std::string(kTwoBones) + "\n[bushing.pad]\nfrom = { body = \"femur\" }\nto = { body = \"tibia\" }\n"
                                        "stiffness = [1, 1, 1]\n"));
  EXPECT_TRUE(contains(model.table, "bushing,pad,left out,,WARNING: a BushingForce of OpenSim")) << model.table;
}

TEST(ExportScene, SaysWhatOpenSimHasNot) {
  const osim::ExportedModel model = exported(scene_of(kTwoBones));
  for (const char* row : {"ligament,curve,left out,,WARNING: OpenSim has no ligament with the law quadratic\n",
                          "contact,tf,left out,,WARNING: contact of OpenSim-JAM is between meshes",
                          "load,push,left out,,\"WARNING", "surface,ball,kept,/bodyset/femur/ball,",
                          "joint,pf,kept,/jointset/pf,", "surface,floor,left out,,nothing that is written needs it"})
    EXPECT_TRUE(contains(model.table, row)) << row << "\n" << model.table;
  EXPECT_EQ(model.kept + model.left_out, 3u + 2 + 2 + 1 + 2 + 1);
  EXPECT_TRUE(model.forces.empty());
}

}  // namespace
}  // namespace genu::test
