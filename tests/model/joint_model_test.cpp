// A scene turned into indices: bodies, reference poses, slack lengths and the scales everything is measured in.
#include "genu/model/build_model.h"

#include <gtest/gtest.h>

#include "support/scene_model.h"

namespace genu {
namespace {

TEST(JointModel, PlacesChainsOfBodiesWhateverTheirOrder) {
  // The chain ground - a - b is written from its end, so that children come before parents.
  const test::SceneModel s = test::scene_model(R"(format = 1
units = { length = "mm", angle = "deg" }
[body.b]
[body.a]
[body.ground]
fixed = true
[joint.second]
type = "free"
parent = "a"
child = "b"
rotations = ["p x", "q y", "r z"]
translations = ["x", "y", "z"]
reference = { r = 90, x = 10 }
[joint.first]
type = "free"
parent = "ground"
child = "a"
rotations = ["p x", "q y", "r z"]
translations = ["x", "y", "z"]
reference = { r = 90, y = 5 }
)");
  ASSERT_EQ(s.model.moving_count, 2);
  EXPECT_EQ(s.model.bodies[2].moving, -1);
  const Pose& b = s.model.reference_poses[0];
  // a stands at (0, 5) turned by 90 deg: b is 10 mm along a's x = ground's y, turned by 180 deg.
  EXPECT_LT((b.p - Vec3(0, 0.015, 0)).norm(), 1e-16);
  EXPECT_LT((b.R - Vec3(-1, -1, 1).asDiagonal().toDenseMatrix()).norm(), 1e-15);
}

TEST(JointModel, ReferenceLengthsSetSlackLengths) {
  const test::SceneModel s = test::scene_model(
      test::bone_on_ground("{ z = 30 }") +
      test::ligament("l", "[0, 0, 10]", "[0, 0, 0]", "law = \"linear\"\nstiffness = 1000\nreference_strain = 0.25"));
  ASSERT_EQ(s.model.ligaments.size(), 1u);
  EXPECT_NEAR(s.model.ligaments[0].law.slack_length(), 0.032, 1e-16);
}

TEST(JointModel, ScalesFollowSizeAndLoad) {
  const auto scaled = [](double size, double force) {
    const auto point = [&](double x, double y, double z) {
      return "[" + std::to_string(size * x) + ", " + std::to_string(size * y) + ", " + std::to_string(size * z) + "]";
    };
    return test::scene_model(test::bone_on_ground() + test::spring("u", point(10, 0, 0), point(10, 0, 20), 0.001, 20) +
                             test::spring("v", point(-10, 0, 0), point(-10, 0, 20), 0.001, 20) +
                             test::load("w", "force = [0, 0, " + std::to_string(-force) + "]"))
        .model.scales;
  };
  EXPECT_NEAR(scaled(1, 50).length, 0.01 * std::sqrt(4.0 / 5), 3e-3);  // two ends each 10 mm from their middle
  EXPECT_NEAR(scaled(3, 50).length / scaled(1, 50).length, 3, 1e-12);
  EXPECT_NEAR(scaled(1, 50).force, 50, 1e-12);
  EXPECT_NEAR(scaled(1, 500).force, 500, 1e-12);
}

TEST(JointModel, LawsThatCannotBeAreReportedByName) {
  const std::string text =
      test::bone_on_ground("{ z = 30 }") +
      test::ligament("odd", "[0, 0, 10]", "[0, 0, 0]", "law = \"linear\"\nstiffness = 10\nslack_length = 38") +
      test::step("increments = 1");
  Diagnostics out;
  auto scene = parse_scene(text, "scene.toml", out);
  ASSERT_TRUE(scene);
  scene->ligaments[0].numbers[0].value = -1;  // no reader lets this pass; a program may
  EXPECT_FALSE(build_model(place(*scene), {}, out));
  ASSERT_EQ(out.items().size(), 1u);
  EXPECT_EQ(out.items()[0].key, "ligament.odd");
  EXPECT_GT(out.items()[0].line, 0);
  EXPECT_FALSE(out.items()[0].rule.empty());
}

}  // namespace
}  // namespace genu
