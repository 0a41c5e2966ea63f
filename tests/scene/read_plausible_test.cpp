#include "genu/scene/plausible_def.h"

#include "scene/scene_text.h"

namespace genu::scene_test {
namespace {

const std::string kPlausible = "\n[plausible]\n";

TEST(ReadPlausible, LimitsInTheUnitsOfTheFile) {
  Diagnostics out;
  const auto scene = parse_scene(kGoodScene + kPlausible +
                                     "strain = 0.1\nligament_force = 700\ncontact_force = 20\npressure = 5\n"
                                     "travel = 12\nrotation = 400\n",
                                 "s", out);
  ASSERT_TRUE(scene) << all_messages(out);
  EXPECT_TRUE(out.items().empty()) << all_messages(out);
  const PlausibleDef& p = scene->plausible;
  EXPECT_EQ(p.strain, 0.1);
  EXPECT_EQ(p.ligament_force, 700);
  EXPECT_EQ(p.contact_force, 20);
  EXPECT_DOUBLE_EQ(p.pressure, 5e6);
  EXPECT_DOUBLE_EQ(p.travel, 0.012);
  EXPECT_DOUBLE_EQ(p.rotation, 400 * M_PI / 180);
}

TEST(ReadPlausible, DefaultsWhereNothingIsSaid) {
  Diagnostics out;
  for (const std::string& more : {std::string(), kPlausible}) {
    const auto scene = parse_scene(kGoodScene + more, "s", out);
    ASSERT_TRUE(scene) << all_messages(out);
    for (const PlausibleKey& key : kPlausibleKeys)
      EXPECT_EQ(scene->plausible.*key.member, PlausibleDef{}.*key.member) << key.key;
  }
}

TEST(ReadPlausible, Errors) {
  const char* kRules[] = {"must be > 0", "must be > 0 N", "must be > 0 MPa", "must be > 0 mm", "must be > 0 deg"};
  for (const PlausibleKey& key : kPlausibleKeys)
    for (const char* number : {"0", "-1"})
      expect_one_error(kGoodScene + kPlausible + key.key + " = @" + number + "\n", std::string("plausible.") + key.key,
                       number, kRules[static_cast<int>(key.unit)]);
  expect_one_error(kGoodScene + kPlausible + "strain = @\"much\"\n", "plausible.strain", "\"much\"",
                   "must be a number");
}

}  // namespace
}  // namespace genu::scene_test
