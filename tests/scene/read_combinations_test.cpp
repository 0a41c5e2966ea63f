#include "scene/scene_text.h"

#include <numbers>

namespace genu::scene_test {
namespace {

const std::string kScrew = R"([combination.screw]
terms = { "knee.flexion" = 1, knee.rotation = -0.5 }
)";

void expect_screw_refused(const std::string& terms, const std::string& key, const std::string& found,
                          const std::string& rule) {
  SCOPED_TRACE(terms);
  expect_one_error(kGoodScene + edited("{ \"knee.flexion\" = 1, knee.rotation = -0.5 }", terms, kScrew), key, found,
                   rule);
}

TEST(ReadCombinations, Terms) {
  const Scene scene = good(kGoodScene + kScrew);
  ASSERT_EQ(scene.combinations.size(), 1u);
  const CombinationDef& c = scene.combinations[0];
  EXPECT_EQ(c.name, "screw");
  ASSERT_EQ(c.terms.size(), 2u);
  EXPECT_EQ(c.terms[0].coordinate, (CoordinateRef{0, 0}));
  EXPECT_EQ(c.terms[0].factor, 1);
  EXPECT_EQ(c.terms[1].coordinate, (CoordinateRef{0, 2}));
  EXPECT_EQ(c.terms[1].factor, -0.5);
}

TEST(ReadCombinations, TakeNoLoadsAndScaleNone) {
  const std::string load = kGoodScene + kScrew + "[load.turn]\n";
  expect_one_error(load + "on = @\"screw\"\n", "load.turn.on", "\"screw\"", "is a combination");
  expect_one_error(load + "on = \"knee.x\"\nscale = { over = @\"screw\", table = [[0, 1], [1, 2]] }\n",
                   "load.turn.scale.over", "\"screw\"", "is a combination");
}

TEST(ReadCombinations, ArePrescribedInTheUnitOfTheirTerms) {
  const std::string heave = "[combination.heave]\nterms = { knee.y = 1, knee.z = 1 }\n";
  const Scene scene =
      good(edited("\"knee.flexion\" = [0, 70]", "screw = [0, 70], heave = 2", kGoodScene + kScrew + heave));
  const auto& prescribed = scene.steps[0].prescribe;
  ASSERT_EQ(prescribed.size(), 2u);
  EXPECT_EQ(prescribed[0].coordinate, QuantityRef(CoordinateRef{0, 0}, 0));
  EXPECT_TRUE(prescribed[0].coordinate.is_rotation());
  EXPECT_DOUBLE_EQ(prescribed[0].to, 70 * std::numbers::pi / 180);
  EXPECT_FALSE(prescribed[1].coordinate.is_rotation());
  EXPECT_DOUBLE_EQ(prescribed[1].to, 2e-3);
  EXPECT_EQ(quantity_name(scene, prescribed[1].coordinate), "heave");
}

TEST(ReadCombinations, Errors) {
  const std::string key = "combination.screw.terms";
  expect_screw_refused("{ \"knee.flexion\" = 1, \"knee.x\" = @1 }", key + ".knee.x", "1", "a combination has one unit");
  expect_screw_refused("{ \"knee.x\" = 1, \"knee.flexion\" = @1 }", key + ".knee.flexion", "1", "is an angle");
  expect_screw_refused("{ @\"knee.flexio\" = 1 }", key + ".knee.flexio", "", "did you mean \"knee.flexion\"?");
  expect_screw_refused("{ \"knee.flexion\" = @0 }", key + ".knee.flexion", "0", "must not be 0");
  expect_screw_refused("{ \"knee.flexion\" = @[1, 2] }", key + ".knee.flexion", "[1, 2]", "must be a number");
  expect_screw_refused("{ \"knee.flexion\" = 1, knee.flexion = @2 }", key + ".knee.flexion", "2", "is named twice");
  expect_screw_refused("@{ }", key, "a table", "at least one");
  expect_screw_refused("@3", key, "3", "must be a table");
  expect_one_error(kGoodScene + "[combination.@screw]\n", key, "", "is missing");
}

TEST(ReadCombinations, ACombinationIsNoTermOfAnother) {
  expect_one_error(kGoodScene + kScrew + "[combination.next]\nterms = { @screw = 1 }\n", "combination.next.terms.screw",
                   "", "is a combination");
}

TEST(ReadCombinations, MayHaveTheNameOfAJoint) {
  // A coordinate is JOINT.NAME: neither names nor result columns can be confused.
  good(kGoodScene + "[combination.knee]\nterms = { knee.flexion = 2 }\n");
}

TEST(ReadCombinations, AWrongOneDragsNoErrorAlong) {
  const std::string wrong = edited("knee.rotation = -0.5", "knee.rotation = @0", kScrew);
  expect_one_error(edited("\"knee.flexion\" = [0, 70]", "screw = [0, 70]", kGoodScene + wrong),
                   "combination.screw.terms.knee.rotation", "0", "must not be 0");
}

}  // namespace
}  // namespace genu::scene_test
