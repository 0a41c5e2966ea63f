// Moment arms of straight and wrapped paths along a chain of joints, against differences of their lengths.
#include "genu/results/moment_arm_columns.h"

#include <gtest/gtest.h>

#include "genu/core/units.h"
#include "genu/model/ligament_pieces.h"
#include "support/scene_model.h"
#include "support/scenes.h"

namespace genu::test {
namespace {

const std::string kChain = R"(format = 1
units = { length = "mm", angle = "deg" }
moment_arms = ["knee.flexion", "knee.x", "ankle.angle", "knee.rotation"]
[body.femur]
fixed = true
[body.tibia]
[body.foot]
[joint.knee]
type = "free"
parent = "femur"
child = "tibia"
rotations = ["flexion -z", "adduction x", "rotation y"]
translations = ["x", "y", "z"]
reference = { flexion = 40, adduction = 5, rotation = -8, x = 3, y = 2 }
[joint.ankle]
type = "revolute"
parent = "tibia"
child = "foot"
origin = [0, -380, 5]
axis = [0.1, 0, 1]
[surface.heel]
body = "tibia"
shape = "cylinder"
radius = 50
origin = [0, -340, 0]
[ligament.straight]
from = { body = "femur", point = [20, 10, -30] }
to = { body = "tibia", point = [10, -60, -20] }
law = "linear"
stiffness = 100
slack_length = 60
[load.gastrocnemius]
from = { body = "femur", point = [-25, 30, 10] }
to = { body = "foot", point = [-45, -30, 8] }
wrap = [{ surface = "heel", side = [-1, 0, 0] }]
magnitude = 10
[[step]]
prescribe = { "knee.flexion" = [40, 50] }
)";

TEST(MomentArms, AreDerivativesOfLengths) {
  Diagnostics out;
  const auto scene = parse_scene(kChain, "scene.toml", out);
  ASSERT_TRUE(scene.has_value()) << messages(out);
  const auto p = prepare(*scene, std::make_shared<MeshLibrary>(), out);
  ASSERT_TRUE(p.has_value()) << messages(out);
  const JointModel& model = p->model;
  const State at_reference = reference_state(model);
  const auto length_of = [&](const std::string& name, const CoordinateRef& c, double change) {
    State moved = at_reference;
    moved.coordinates[at(c.joint)][at(c.index)] += change;
    moved.poses = poses_from_coordinates(model, moved.coordinates);
    settle_wraps(model, moved);
    double length = 0;
    for_each_path(model, [&](const LigamentPath& path, const std::string& path_name) {
      if (path_name == name) length = path.length(moved.poses, moved.wraps);
    });
    return length;
  };
  State state = at_reference;
  settle_wraps(model, state);
  EXPECT_TRUE(state.wraps.at(0).touching);
  ResultTable table;
  add_moment_arm_columns(p->scene, model, table);
  table.add_row();
  set_moment_arm_columns(p->scene, model, state, table);
  EXPECT_EQ(table.columns().size(), 8u);
  for (const std::string path : {"straight", "gastrocnemius"})
    for (const CoordinateRef& c : p->scene.moment_arms) {
      const bool angle = c.index < 3;
      const double h = angle ? 1e-5 : 1e-7;
      const double arm = -(length_of(path, c, h) - length_of(path, c, -h)) / (2 * h) * (angle ? to::kMillimetre : 1);
      const std::string column = path + ".moment_arm." + coordinate_name(p->scene, c) + (angle ? "_mm" : "");
      EXPECT_NEAR(table.number(0, column), arm, 1e-6) << column;
    }
  EXPECT_NEAR(table.number(0, "straight.moment_arm.ankle.angle_mm"), 0, 1e-12);
  EXPECT_GT(std::abs(table.number(0, "gastrocnemius.moment_arm.ankle.angle_mm")), 5);
}

}  // namespace
}  // namespace genu::test
