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
  s.effects.push_back({"ligaments", 7, "no unknowns", 21, 0.5});
  s.effects.push_back({"moving bodies", 1, "6 unknowns each: 6"});
  s.seconds.emplace_back("solving", 0.25);
  const auto json = nlohmann::json::parse(to_json(s), nullptr, false);
  ASSERT_FALSE(json.is_discarded()) << to_json(s);
  EXPECT_EQ(json["verdict"].size(), 2u);
  EXPECT_EQ(json["poses"]["solved"], 2);
  EXPECT_EQ(json["exit_code"], 3);
  EXPECT_TRUE(json["certificate"]["smallest_gap_mm"].is_null());  // JSON has no infinity
  EXPECT_EQ(json["effects"][0]["count"], 7);
  EXPECT_EQ(json["effects"][0]["evaluations"], 21);
  EXPECT_EQ(json["effects"][0]["seconds"], 0.5);
  EXPECT_FALSE(json["effects"][1].contains("evaluations"));
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

TEST(Summary, CountsContactsWhereAPairCanHaveThem) {
  RunSummary s;
  s.poses_asked = s.poses_solved = s.poses_stable = 4;
  EXPECT_NE(to_text(s).find("4 of 4 solved, 4 of them stable\n"), std::string::npos) << to_text(s);
  EXPECT_EQ(to_text(s).find(" contacts"), std::string::npos) << to_text(s);
  EXPECT_FALSE(nlohmann::json::parse(to_json(s)).contains("contacts"));
  s.rigid_pairs = 1;
  s.most_contacts = 2;
  EXPECT_NE(to_text(s).find("stable; 0 to 2 contacts"), std::string::npos) << to_text(s);
  EXPECT_EQ(nlohmann::json::parse(to_json(s))["contacts"]["most"], 2);
}

}  // namespace
}  // namespace genu
