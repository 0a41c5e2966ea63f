#include "scene/scene_text.h"

namespace genu::scene_test {
namespace {

TEST(ReadBodies, InTheOrderOfTheFile) {
  const Scene scene = good(kGoodScene);
  ASSERT_EQ(scene.bodies.size(), 2u);
  EXPECT_EQ(scene.bodies[0].name, "tibia");
  EXPECT_TRUE(scene.bodies[0].fixed);
  EXPECT_EQ(scene.bodies[1].name, "femur");
  EXPECT_FALSE(scene.bodies[1].fixed);
  EXPECT_EQ(scene.bodies[1].where.line, 8);
}

TEST(ReadBodies, Kinds) {
  expect_refused("fixed = true", "fixed = @1", "body.tibia.fixed", "1", "must be true or false");
  // Without a fixed body the tibia is a moving one without a joint, too: two errors, both true.
  Diagnostics out;
  EXPECT_FALSE(parse_scene(edited("fixed = true", "fixed = false"), "s", out));
  ASSERT_EQ(out.items().size(), 2u) << all_messages(out);
  EXPECT_EQ(to_string(out.items()[0]), "s:5:2: body: at least one body must be fixed: [body.NAME] with fixed = true");
  EXPECT_EQ(to_string(out.items()[1]), "s:5:7: body.tibia: a moving body must be the child of one joint");
}

TEST(ReadBodies, NothingMoves) {
  expect_one_error("format = 1\nunits = { length = \"m\", angle = \"rad\" }\n[@body.tibia]\nfixed = true\n[[step]]\n",
                   "body", "", "at least one body must be free to move");
  expect_one_error("@format = 1\nunits = { length = \"m\", angle = \"rad\" }\n[[step]]\n", "body", "",
                   "at least one body must be fixed");
}

TEST(ReadBodies, Keys) {
  expect_refused("[body.femur]\n", "[body.femur]\n@mass = 3.5\n", "body.femur.mass", "3.5", "has no effect");
  expect_refused("[body.femur]\n", "[body.femur]\n@centre_of_mass = [0, 0, 0]\n", "body.femur.centre_of_mass",
                 "[0, 0, 0]", "has no effect");
  expect_refused("[body.femur]\n", "[body.femur]\n@inertia = [1, 1, 1]\n", "body.femur.inertia", "[1, 1, 1]",
                 "only in a scene with [dynamics]");
  expect_refused("fixed = true", "fixed = true\n@fixd = true", "body.tibia.fixd", "true",
                 "is no key of a body; did you mean \"fixed\"?");
}

TEST(ReadBodies, GravityGivesThemWeight) {
  const std::string heavy = edited("[body.femur]\n", "[body.femur]\nmass = 3.5\ncentre_of_mass = [1, 2, 300]\n");
  const Scene scene = good(edited("[body.tibia]", kGravity + "[body.tibia]", heavy));
  ASSERT_TRUE(scene.gravity.has_value());
  EXPECT_EQ(*scene.gravity, Vec3(0, -9.81, 0)) << "m/s^2 whatever the unit of length";
  EXPECT_EQ(scene.bodies[1].mass, 3.5);
  EXPECT_TRUE(scene.bodies[1].centre_of_mass.isApprox(Vec3(1e-3, 2e-3, 0.3), 1e-15));
  EXPECT_EQ(scene.bodies[0].mass, 0) << "a body without a mass has no weight";
  EXPECT_FALSE(good(kGoodScene).gravity.has_value());
}

TEST(ReadBodies, GravityErrors) {
  const auto refused = [](const std::string& gravity, const std::string& body, const std::string& key,
                          const std::string& found, const std::string& rule) {
    const std::string text = edited("[body.femur]\n", "[body.femur]\n" + body);
    expect_one_error(edited("[body.tibia]", gravity + "[body.tibia]", text), key, found, rule);
  };
  const std::string kMass = "mass = 3.5\n";
  refused("gravity = @9.81\n", kMass, "gravity", "9.81", "three numbers [x, y, z], in m/s^2");
  refused("gravity = [0, @inf, 0]\n", kMass, "gravity[2]", "inf", "finite");
  refused("gravity = @[0, -9.81, 0]\n", "", "gravity", "[0, -9.81, 0]", "no body has a mass");
  refused(kGravity, "mass = @0\n", "body.femur.mass", "0", "must be > 0 kg");
  refused(kGravity, kMass + "centre_of_mass = @3\n", "body.femur.centre_of_mass", "3", "three numbers");
  refused(kGravity, kMass + "@inertia = [1, 1, 1]\n", "body.femur.inertia", "[1, 1, 1]", "only in a scene with");
  refused(kGravity, kMass + "[body.patella]\nfixed = true\nmass = @1\n", "body.patella.mass", "1", "fixed body");
  refused(kGravity, kMass + "[body.patella]\nfixed = true\ncentre_of_mass = @[0, 0, 0]\n",
          "body.patella.centre_of_mass", "[0, 0, 0]", "there is no mass");
}

TEST(ReadBodies, Names) {
  expect_refused("[body.femur]\n", "[body.femur]\n[body.@\"2nd bone\"]\nfixed = true\n", "body.2nd bone",
                 "\"2nd bone\"", "a name is a letter");
  expect_refused("[body.femur]\n", "[body.femur]\n[body.@\"\"]\nfixed = true\n", "body.", "\"\"", "a name is a letter");
  expect_one_error(
      "body = @3\n" + edited("[body.tibia]\nfixed = true\n\n[body.femur]\n", "",
                             "format = 1\nunits = { length = \"m\", angle = \"rad\" }\n[body.tibia]\nfixed "
                             "= true\n\n[body.femur]\n[[step]]\n"),
      "body", "3", "must be tables with names: [body.NAME]");
}

}  // namespace
}  // namespace genu::scene_test
