#include "scene/scene_text.h"

namespace genu::scene_test {
namespace {

using Comparison = RegionDef::Comparison;
const std::string kPair = R"(surfaces = ["ball", "floor"])";
const std::string kRegions = R"(regions = { inner = "z < 0", outer = "z >= 0 and x < 5" })";

TEST(ReadContacts, PairAndRegions) {
  const Scene scene = good(kGoodScene);
  ASSERT_EQ(scene.contacts.size(), 1u);
  const ContactDef& contact = scene.contacts[0];
  EXPECT_EQ(contact.name, "medial");
  EXPECT_EQ(contact.surface_a, 0);
  EXPECT_EQ(contact.surface_b, 1);
  ASSERT_EQ(contact.regions.size(), 2u);
  EXPECT_EQ(contact.regions[0].name, "inner");
  const auto& outer = contact.regions[1].conditions;
  ASSERT_EQ(outer.size(), 2u);
  EXPECT_EQ(outer[0].axis, 2);
  EXPECT_EQ(outer[0].comparison, Comparison::greater_equal);
  EXPECT_EQ(outer[1].axis, 0);
  EXPECT_EQ(outer[1].comparison, Comparison::less);
  EXPECT_DOUBLE_EQ(outer[1].value, 5e-3);
}

TEST(ReadContacts, RegionsInEveryWayOfWriting) {
  const Scene scene = good(edited(kRegions, "regions = { a = \" y<=-1.5e1and x>2\", b = 'z  >  0.25  ' }"));
  const auto& a = scene.contacts[0].regions[0].conditions;
  ASSERT_EQ(a.size(), 2u);
  EXPECT_EQ(a[0].axis, 1);
  EXPECT_EQ(a[0].comparison, Comparison::less_equal);
  EXPECT_DOUBLE_EQ(a[0].value, -0.015);
  EXPECT_EQ(a[1].comparison, Comparison::greater);
  EXPECT_DOUBLE_EQ(scene.contacts[0].regions[1].conditions[0].value, 0.25e-3);
  EXPECT_TRUE(good(edited(kRegions, "")).contacts[0].regions.empty());
}

TEST(ReadContacts, RegionErrors) {
  for (const std::string bad : {"", "z", "z <", "w < 0", "z = 0", "z < 0 or x < 0", "z < 0 and", "0 < z", "z < nan",
                                "z < inf", "z < 1e999", "z < 0 x", "z << 0", "and z < 0", "z < 5 mm"}) {
    expect_refused("\"z < 0\"", "@\"" + bad + "\"", "contact.medial.regions.inner", "\"" + bad + "\"",
                   "must be conditions such as");
  }
  expect_refused("\"z < 0\"", "@0", "contact.medial.regions.inner", "0", "must be a string");
  expect_refused("inner =", "@\"in.ner\" =", "contact.medial.regions.in.ner", "\"in.ner\"", "a name is a letter");
  expect_refused(kRegions, "regions = @[1]", "contact.medial.regions", "[1]", "must be a table");
}

TEST(ReadContacts, Pair) {
  expect_refused("\"ball\", \"floor\"", "@\"bal\", \"floor\"", "contact.medial.surfaces[1]", "\"bal\"",
                 "unknown surface; known: \"ball\", \"floor\"; did you mean \"ball\"?");
  expect_refused("\"ball\", \"floor\"", "\"ball\", @2", "contact.medial.surfaces[2]", "2", "must be a string");
  expect_refused(kPair, "surfaces = @[\"ball\"]", "contact.medial.surfaces", "[\"ball\"]",
                 "must be the names of two surfaces");
  expect_refused(kPair, "surfaces = @[\"ball\", \"ball\"]", "contact.medial.surfaces", "[\"ball\", \"ball\"]",
                 "both surfaces are on body.femur");
  expect_refused("[contact.medial]\n" + kPair, "[contact.@medial]", "contact.medial.surfaces", "", "is missing");
}

TEST(ReadContacts, BodiesOfThePair) {
  const std::string other = "[surface.cup]\nbody = \"femur\"\nshape = \"plane\"\n";
  expect_one_error(edited(kPair, "surfaces = @[\"ball\", \"cup\"]", kGoodScene + other), "contact.medial.surfaces",
                   "[\"ball\", \"cup\"]", "both surfaces are on body.femur");
}

TEST(ReadContacts, FixedBodiesNeverMeet) {
  const std::string ground = "[body.ground]\nfixed = true\n[surface.rock]\nbody = \"ground\"\nshape = \"plane\"\n";
  expect_one_error(edited(kPair, "surfaces = @[\"rock\", \"floor\"]", kGoodScene + ground), "contact.medial.surfaces",
                   "[\"rock\", \"floor\"]", "both surfaces are on fixed bodies");
}

TEST(ReadContacts, SamePairTwice) {
  expect_one_error(kGoodScene + "[contact.again]\nsurfaces = @[\"floor\", \"ball\"]\nmodel = \"rigid\"\n",
                   "contact.again.surfaces", "[\"floor\", \"ball\"]", "contact.medial has the same pair");
}

TEST(ReadContacts, Model) {
  expect_refused("model = \"rigid\"", "model = @\"cartilage\"", "contact.medial.model", "\"cartilage\"",
                 "not built yet: model \"cartilage\"");
  expect_refused("model = \"rigid\"", "model = @\"rigit\"", "contact.medial.model", "\"rigit\"",
                 "must be \"rigid\"; did you mean \"rigid\"?");
  expect_refused("[contact.medial]\n" + kPair + "\nmodel = \"rigid\"", "[contact.@medial]\n" + kPair,
                 "contact.medial.model", "", "is missing");
  for (const std::string key : {"modulus", "poisson", "thickness", "law", "quadrature", "cast_from", "search_depth"}) {
    expect_refused("model = \"rigid\"", "model = \"rigid\"\n@" + key + " = 1", "contact.medial." + key, "1",
                   "not built yet");
  }
  expect_refused("model = \"rigid\"", "model = \"rigid\"\n@friction = 1", "contact.medial.friction", "1",
                 "is no key of a rigid contact");
}

}  // namespace
}  // namespace genu::scene_test
