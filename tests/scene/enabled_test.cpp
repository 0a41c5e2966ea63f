#include "scene/scene_text.h"

namespace genu::scene_test {
namespace {

const std::string kLigamentTable = "[ligament.AAC]\n", kContactTable = "[contact.medial]\n",
                  kLoadTable = "[load.push]\n";
const std::string kDisabled = "enabled = false\n";

TEST(Enabled, ADisabledTableIsReadAndLeftOut) {
  const Scene scene = good(edited(kLigamentTable, kLigamentTable + kDisabled));
  EXPECT_TRUE(scene.ligaments.empty());
  ASSERT_EQ(scene.disabled.size(), 1u);
  EXPECT_EQ(scene.disabled[0].group + "." + scene.disabled[0].name, "ligament.AAC");
  EXPECT_EQ(good(edited(kLigamentTable, kLigamentTable + "enabled = true\n")).ligaments.size(), 1u);
}

TEST(Enabled, StepsMayNameADisabledLoad) {
  const Scene scene = good(edited(kLoadTable, kLoadTable + kDisabled));
  EXPECT_TRUE(scene.loads.empty());
  EXPECT_TRUE(scene.steps[0].factors.empty());
}

TEST(Enabled, TwoContactsOfOnePairMayStandSideBySide) {
  const std::string other = "[contact.soft]\nsurfaces = [\"ball\", \"floor\"]\nmodel = \"rigid\"\n";
  const Scene scene = good(edited(kContactTable, other + kDisabled + kContactTable));
  ASSERT_EQ(scene.contacts.size(), 1u);
  EXPECT_EQ(scene.contacts[0].name, "medial");
}

TEST(Enabled, WhatIsWrongInItIsStillRefused) {
  expect_refused("stiffness = 37200.0", "stiffness = @-2\nenabled = false", "ligament.AAC.stiffness", "-2", "must be");
  expect_refused(kLigamentTable, kLigamentTable + "enabled = @\"no\"\n", "ligament.AAC.enabled", "\"no\"",
                 "true or false");
}

}  // namespace
}  // namespace genu::scene_test
