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
  expect_refused("[body.femur]\n", "[body.femur]\n@mass = 3.5\n", "body.femur.mass", "3.5", "not built yet");
  expect_refused("[body.femur]\n", "[body.femur]\n@centre_of_mass = [0, 0, 0]\n", "body.femur.centre_of_mass",
                 "[0, 0, 0]", "not built yet");
  expect_refused("[body.femur]\n", "[body.femur]\n@inertia = [1, 1, 1]\n", "body.femur.inertia", "[1, 1, 1]",
                 "not built yet");
  expect_refused("fixed = true", "fixed = true\n@fixd = true", "body.tibia.fixd", "true",
                 "is no key of a body; did you mean \"fixed\"?");
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
