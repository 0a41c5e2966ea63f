#include "scene/scene_text.h"

namespace genu::scene_test {
namespace {

const std::string kAxes =
    "grood_suntay = { side = \"left\", femur = { body = \"femur\", proximal = \"-z\", anterior = [1, 0, 1], origin = "
    "[1, 2, 3] }, tibia = { body = \"tibia\", proximal = [0, 2, 0], anterior = \"x\" } }\n";
const std::string kScene = edited("reference = {", kAxes + "reference = {");

void expect_axes_refused(const std::string& piece, const std::string& replacement, const std::string& key,
                         const std::string& found, const std::string& rule) {
  SCOPED_TRACE(replacement);
  expect_one_error(edited(piece, replacement, kScene), "joint.knee.grood_suntay" + key, found, rule);
}

TEST(ReadGroodSuntay, AxesAreUnitAndPerpendicular) {
  const Scene scene = good(kScene);
  ASSERT_TRUE(scene.joints[0].grood_suntay.has_value());
  const GroodSuntayDef& def = *scene.joints[0].grood_suntay;
  EXPECT_FALSE(def.right);
  EXPECT_EQ(scene.bodies[static_cast<std::size_t>(def.femur.body)].name, "femur");
  EXPECT_EQ(scene.bodies[static_cast<std::size_t>(def.tibia.body)].name, "tibia");
  EXPECT_EQ(def.femur.proximal, -Vec3::UnitZ());
  EXPECT_LT((def.femur.anterior - Vec3::UnitX()).norm(), 1e-15);
  EXPECT_LT((def.femur.origin - Vec3(1e-3, 2e-3, 3e-3)).norm(), 1e-18);
  EXPECT_EQ(def.tibia.proximal, Vec3::UnitY());
  EXPECT_EQ(def.tibia.origin, Vec3::Zero());
}

TEST(ReadGroodSuntay, APatellaMayStandForTheTibia) {
  const Scene scene = good(edited(", tibia = { body", ", patella = { body", kScene));
  ASSERT_TRUE(scene.joints[0].grood_suntay.has_value());
  EXPECT_TRUE(scene.joints[0].grood_suntay->patella);
  EXPECT_FALSE(good(kScene).joints[0].grood_suntay->patella);
}

TEST(ReadGroodSuntay, AJointWithoutItHasNone) { EXPECT_FALSE(good(kGoodScene).joints[0].grood_suntay.has_value()); }

TEST(ReadGroodSuntay, RefusesWhatIsNoKnee) {
  expect_axes_refused("\"left\"", "@\"port\"", ".side", "\"port\"", "must be one of \"right\", \"left\"");
  expect_axes_refused("\"-z\"", "@\"up\"", ".femur.proximal", "\"up\"", "must be one of \"x\"");
  expect_axes_refused("[0, 2, 0]", "@[0, 0, 0]", ".tibia.proximal", "[0, 0, 0]", "must have a direction");
  expect_axes_refused("anterior = \"x\"", "anterior = @\"-y\"", ".tibia.anterior", "\"-y\"", "is parallel to proximal");
  expect_axes_refused("body = \"tibia\", proximal", "body = @\"patella\", proximal", ".tibia.body", "\"patella\"",
                      "unknown body; known: \"tibia\", \"femur\"");
  expect_axes_refused(", tibia = { body = \"tibia\"", ", tibia = @{ body = \"femur\"", ".tibia", "a table",
                      "has the same body as the femur");
}

}  // namespace
}  // namespace genu::scene_test
