#include "scene/scene_text.h"

namespace genu::scene_test {
namespace {

const std::string kFirstStep = "[[step]]";

std::string bundled(const std::string& keys) { return "[bundle.B]\n" + keys + "\n[[step]]"; }

TEST(ReadBundles, ANameAPatternOrSeveral) {
  const Scene one = good(edited(kFirstStep, bundled("fibres = \"A*\"")));
  ASSERT_EQ(one.bundles.size(), 1u);
  EXPECT_EQ(one.bundles[0].name, "B");
  ASSERT_FALSE(one.bundles[0].members.empty());
  for (const std::string& fibre : one.bundles[0].fibres) EXPECT_EQ(fibre[0], 'A');
  EXPECT_EQ(good(edited(kFirstStep, bundled("fibres = [\"AAC\"]"))).bundles[0].members, std::vector<int>{0});
}

TEST(ReadBundles, ANameStandsForItsFibres) {
  const Scene scene = good(edited(kFirstStep, bundled("fibres = \"AAC\"")));
  EXPECT_EQ(with_fibres(scene, "B.stiffness"), (std::vector<std::string>{"B.stiffness", "AAC.stiffness"}));
  EXPECT_EQ(with_fibres(scene, "ligament.B.from.x"), (std::vector<std::string>{"ligament.B.from.x", "AAC.from.x"}));
  EXPECT_EQ(with_fibres(scene, "C.stiffness").size(), 1u);
  EXPECT_TRUE(matches(scene, "B.*", "AAC.stiffness"));
}

TEST(ReadBundles, WhatIsNoneIsRefused) {
  expect_refused(kFirstStep, bundled("fibres = @\"AAD\""), "bundle.B.fibres", "\"AAD\"", "names no ligament");
  expect_refused(kFirstStep, bundled("fibres = @[]"), "bundle.B.fibres", "[]", "at least one");
  expect_refused(kFirstStep, bundled("fibres = @3"), "bundle.B.fibres", "3", "must be a string");
  expect_refused(kFirstStep, bundled("fibres = \"AAC\"\n@fibers = 2"), "bundle.B.fibers", "2", "is no key of a bundle");
  expect_refused(kFirstStep, "[bundle.@B]\n[[step]]", "bundle.B.fibres", "", "is missing");
}

}  // namespace
}  // namespace genu::scene_test
