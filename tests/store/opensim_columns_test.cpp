// Names for OpenSim: those of the published knees, and such as genu reads again.
#include "genu/store/opensim_columns.h"

#include <gtest/gtest.h>

#include "genu/assemble/opensim_names.h"
#include "genu/scene/reader.h"
#include "support/published_knee.h"
#include "support/scenes.h"
#include "tools/cli_scenes.h"

namespace genu {
namespace {

PlacedScene named_scene(const std::string& text) {
  Diagnostics out;
  const auto scene = parse_scene(text, "scene.toml", out);
  EXPECT_TRUE(scene.has_value()) << test::messages(out);
  return place(*scene);
}

std::vector<std::string> names_of(const PlacedScene& scene, const OpenSimNameOptions& options) {
  Diagnostics out;
  std::vector<std::string> found;
  const auto names = opensim_column_names(scene, options, out);
  EXPECT_TRUE(names.has_value()) << test::messages(out);
  if (!names) return found;
  for (const auto& [c, name] : *names) {
    found.push_back(name);
    if (!options.columns.empty()) continue;
    EXPECT_EQ(opensim_coordinates(scene, name), std::vector<CoordinateRef>{c}) << name;
  }
  return found;
}

TEST(OpenSimColumns, AreThoseOfThePublishedKnee) {
  GENU_NEEDS_DATA("lenhart2015/lenhart_passive_flexion.csv");
  const PlacedScene scene = named_scene(test::published_scene(test::data_path("lenhart2015/ACLC01-R-femur-cart.stl")));
  const test::PublishedTable published("lenhart_passive_flexion.csv");
  const auto names = names_of(scene, {"", "r"});
  EXPECT_EQ(names.size(), 12u);
  for (const std::string& name : names) EXPECT_FALSE(std::isnan(published.at(0, name))) << name;
}

TEST(OpenSimColumns, ReadBackWhateverTheNamesAre) {
  EXPECT_EQ(names_of(named_scene(test::kBall), {}),
            (std::vector<std::string>{"knee_flex", "knee_add", "knee_rot", "knee_tx", "knee_ty", "knee_tz"}));
  const auto with = [](const std::string& piece, const std::string& by) {
    std::string text = test::with_first(test::kBall, piece, by);
    return names_of(named_scene(text.substr(0, text.find("[[step]]")) + "[[step]]\nincrements = 1\n"), {"", "l"});
  };
  EXPECT_EQ(with("[joint.knee]", "[joint.knee_r]")[0], "knee_flex_r") << "the joint's own side stands";
  EXPECT_EQ(with("\"rotation z\"", "\"rotation2 z\"")[2], "knee_rotation2_l");
  EXPECT_EQ(with("\"adduction y\"", "\"flexio y\"")[0], "knee_flexion_l") << "flex could be two";
}

TEST(OpenSimColumns, MayBeTheUsersOwnAndRefuseWhatCannotBe) {
  const PlacedScene scene = named_scene(test::kBall);
  EXPECT_EQ(names_of(scene, {"knee.flexion = knee_angle_r ,knee.z=up", "r"})[0], "knee_angle_r");
  const auto why = [&](const OpenSimNameOptions& options) {
    Diagnostics out;
    EXPECT_FALSE(opensim_column_names(scene, options, out).has_value());
    return test::messages(out);
  };
  EXPECT_TRUE(test::contains(why({"knee.flexoin=a", ""}), "did you mean \"knee.flexion\"?"));
  EXPECT_TRUE(test::contains(why({"knee.flexion", ""}), "must be COORDINATE=NAME"));
  EXPECT_TRUE(test::contains(why({"knee.flexion=a b", ""}), "without blanks"));
  EXPECT_TRUE(test::contains(why({"knee.flexion=a, knee.flexion=b", ""}), "is given twice"));
  EXPECT_TRUE(test::contains(why({"knee.flexion=knee_ADD", ""}), "both knee.flexion and knee.adduction"));
  EXPECT_TRUE(test::contains(why({"knee.flexion=time", ""}), "the column of times"));
  EXPECT_TRUE(test::contains(why({"", "left"}), "must be r or l"));
}

}  // namespace
}  // namespace genu
