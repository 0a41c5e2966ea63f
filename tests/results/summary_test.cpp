#include "genu/results/summary.h"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace genu {
namespace {

TEST(Summary, IsValidJsonWhateverItsWords) {
  RunSummary s;
  s.scene_file = "a\"b\\c\n\xff.toml";  // file names need not be UTF-8
  s.verdict = {"one", "two"};
  s.poses_asked = 3;
  s.poses_solved = 2;
  s.exit_code = 3;
  s.smallest_force = s.smallest_gap = std::numeric_limits<double>::infinity();
  s.effects.push_back({"ligaments", 7, "no unknowns"});
  s.seconds.emplace_back("solving", 0.25);
  const auto json = nlohmann::json::parse(to_json(s), nullptr, false);
  ASSERT_FALSE(json.is_discarded()) << to_json(s);
  EXPECT_EQ(json["verdict"].size(), 2u);
  EXPECT_EQ(json["poses"]["solved"], 2);
  EXPECT_EQ(json["exit_code"], 3);
  EXPECT_TRUE(json["certificate"]["smallest_gap_mm"].is_null());  // JSON has no infinity
  EXPECT_EQ(json["effects"][0]["count"], 7);
  EXPECT_EQ(json["seconds"]["solving"], 0.25);
}

TEST(Summary, SaysHowWellContactsAreLocated) {
  RunSummary s;
  ContactLocation location;
  location.contact = "medial";
  location.spread = 1.3e-3;
  location.least_curvature = 8;
  location.curvature_uncertainty = 2;
  location.doubtful = 5;
  location.poses = 91;
  s.locations = {location};
  const auto json = nlohmann::json::parse(to_json(s))["contact_location"][0];
  EXPECT_EQ(json["contact"], "medial");
  EXPECT_DOUBLE_EQ(json["worst_mm"], 1.3);
  EXPECT_EQ(json["least_ratio"], 4);
  EXPECT_EQ(json["poses_below_ratio_10"], 5);
  EXPECT_EQ(json["poses"], 91);
  EXPECT_FALSE(nlohmann::json::parse(to_json(RunSummary{})).contains("contact_location"));
}

TEST(Summary, EmptyOneIsValidToo) {
  EXPECT_FALSE(nlohmann::json::parse(to_json(RunSummary{}), nullptr, false).is_discarded());
  EXPECT_FALSE(to_text(RunSummary{}).empty());
}

TEST(Summary, TheTerminalSeesEverySentenceOfTheVerdict) {
  RunSummary s;
  s.verdict = {"First thing.", "Second thing."};
  const std::string text = to_text(s);
  EXPECT_LT(text.find("First thing."), text.find("Second thing."));
  EXPECT_NE(text.find("Second thing."), std::string::npos);
}

}  // namespace
}  // namespace genu
