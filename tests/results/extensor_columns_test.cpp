// The extensor mechanism of a patella on cords: which loads and ligaments it is made of, and what its columns hold.
#include "genu/results/extensor_columns.h"

#include <gtest/gtest.h>

#include "genu/results/columns.h"
#include "genu/results/pose_table.h"
#include "support/scene_model.h"

namespace genu {
namespace {

/// A patella between a femur and a tibia that are fixed: two muscles and a push, two fibres of a tendon,
/// and a ligament to the femur that is none of the tendon.
const char* const kScene = R"(format = 1
units = { length = "mm", angle = "deg" }
[body.femur]
fixed = true
[body.tibia]
fixed = true
[body.patella]
[joint.pf]
type = "free"
parent = "femur"
child = "patella"
rotations = ["flexion -z", "rotation x", "tilt y"]
translations = ["x", "y", "z"]
grood_suntay = { side = "right", femur = { body = "femur", proximal = "y", anterior = "x" }, patella = { body = "patella", proximal = "y", anterior = "x" } }
[load.rectus]
from = { body = "femur", point = [30, 200, 0] }
to = { body = "patella", point = [0, 20, 0] }
magnitude = 100
activation = 0.5
[load.vastus]
body = "patella"
toward = { body = "femur", point = [0, 100, 0] }
magnitude = 30
[load.push]
body = "patella"
force = [0, 0, 70]
[ligament.PT1]
from = { body = "patella", point = [0, -20, 5] }
to = { body = "tibia", point = [30, -70, 5] }
law = "spring"
stiffness = 2
slack_length = 40
[ligament.PT2]
from = { body = "tibia", point = [30, -70, -5] }
to = { body = "patella", point = [0, -20, -5] }
law = "spring"
stiffness = 3
slack_length = 40
[ligament.mPFL]
from = { body = "femur", point = [0, 0, -40] }
to = { body = "patella", point = [0, 0, -20] }
law = "spring"
stiffness = 1
slack_length = 10
[[step]]
prescribe = { "pf.flexion" = 0 }
load = { vastus = [0, 1] }
increments = 1
)";

ResultTable table_at(const test::SceneModel& s, double factor) {
  PoseRecord record;
  PosePoint& point = record.point;
  point.step = 1;
  point.report.status = PoseStatus::ok;
  point.target = test::target_of(s.scene);
  point.target.load_factors[1] = factor;
  point.pose.state = reference_state(s.model);
  point.pose.state.multipliers.assign(point.target.prescribed.size(), 0.0);
  return pose_table(s.scene, s.model, plan_steps(s.scene), {record});
}

TEST(ExtensorColumns, AreTheForcesOfMusclesAndTendon) {
  const test::SceneModel s = test::scene_model(kScene);
  const auto all = extensor_mechanisms(s.scene);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].quadriceps, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(all[0].tendon, (std::vector<std::size_t>{0, 1}));
  EXPECT_TRUE(all[0].contacts.empty());
  const ResultTable t = table_at(s, 0.4);
  const double muscle = 0.5 * 100 + 0.4 * 30;
  const double tendon = t.number(0, "PT1.force_N") + t.number(0, "PT2.force_N");
  EXPECT_GT(t.number(0, "PT1.force_N"), 10);
  EXPECT_DOUBLE_EQ(t.number(0, "pf.quadriceps.force_N"), muscle);
  EXPECT_DOUBLE_EQ(t.number(0, "pf.patellar_tendon.force_N"), tendon);
  EXPECT_DOUBLE_EQ(t.number(0, "pf.tendon_to_quadriceps"), tendon / muscle);
}

TEST(ExtensorColumns, ThePatellaIsDescribedInItsWords) {
  test::SceneModel s = test::scene_model(kScene);
  const JointDef& joint = s.scene.joints[0];
  ASSERT_TRUE(joint.grood_suntay && joint.grood_suntay->patella);
  const ResultTable t = table_at(s, 1);
  for (const char* name : {"pf.gs.flexion_deg", "pf.gs.medial_rotation_deg", "pf.gs.lateral_tilt_deg",
                           "pf.gs.lateral_shift_mm", "pf.gs.anterior_mm", "pf.gs.proximal_mm"})
    EXPECT_TRUE(t.has_column(name)) << name;
  // Of a right knee with z to the right: lateral is +z, proximal +y, and a tilt about -y turns the front there.
  Pose patella{exp_rotation(Vec3(0, -0.2, 0)), Vec3(0.05, 0.01, 0.004)};
  const auto m = grood_suntay(*joint.grood_suntay, {}, patella);
  ASSERT_TRUE(m);
  const auto numbers = clinical_numbers(joint, *m);
  EXPECT_NEAR(numbers[2], 0.2, 1e-14);
  EXPECT_NEAR(numbers[3], 0.004, 1e-16);
  EXPECT_NEAR(numbers[5], 0.01, 1e-16);
}

TEST(ExtensorColumns, WithoutAPatellaThereAreNone) {
  std::string text = kScene;
  text.erase(text.find("grood_suntay"), text.find("[load.rectus]") - text.find("grood_suntay"));
  const test::SceneModel s = test::scene_model(text);
  EXPECT_TRUE(extensor_mechanisms(s.scene).empty());
  EXPECT_FALSE(table_at(s, 1).has_column("pf.quadriceps.force_N"));
}

}  // namespace
}  // namespace genu
