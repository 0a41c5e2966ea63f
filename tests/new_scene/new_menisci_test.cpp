// The menisci of a new knee are four fibres.
#include "genu/new_scene/new_menisci.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/text.h"

namespace genu {
namespace {

/// Bones that are the reference knee's own, the femur raised by 2 mm.
FittedKnee raised_reference() {
  FittedKnee fitted;
  fitted.femur.placed = {Mat3::Identity(), Vec3(0, 0.002, 0)};
  fitted.tibia.placed = {Mat3::Identity(), Vec3::Zero()};
  return fitted;
}

TEST(NewMenisci, RunFromTheCondylesForthAndBack) {
  const std::string text = menisci_text(raised_reference());
  for (const char* said : {"[bundle.menisci]", "[ligament.meniscus_medial_posterior]", "point = [0.9, 3, -20.5]",
                           "point = [80.9, 1, -66.5]", "point = [-79.1, 1, -66.5]", "point = [-2.4, 3, 23]", "CHOSEN",
                           "@length of meniscus_lateral_anterior@"})
    EXPECT_TRUE(test::contains(text, said)) << said;
}

TEST(NewMenisci, AreSlackAtFirst) {
  auto lengths = slack_menisci(raised_reference());
  ASSERT_EQ(lengths.size(), 8u);
  for (const auto& [word, text] : lengths)
    EXPECT_EQ(text, word.starts_with("stiffness") ? "stiffness = 1200" : "slack_length = 184.61") << word;
}

TEST(NewMenisci, AreNeutralInTheMeanOfTheFlexion) {
  auto lengths = slack_menisci(raised_reference());
  const std::string name = "meniscus_medial_posterior";
  ResultTable poses;
  poses.add_column(name + ".length_mm");
  for (const double length : {40.0, 44.0}) {
    poses.add_row();
    poses.set(name + ".length_mm", length);
  }
  EXPECT_TRUE(settle_menisci(poses, lengths));
  EXPECT_EQ(lengths.at("length of " + name), "slack_length = 40.98");                      // 42 mm at a strain of 0.025
  EXPECT_EQ(lengths.at("length of meniscus_lateral_posterior"), "slack_length = 184.61");  // it has no column
  EXPECT_FALSE(settle_menisci(poses, lengths));
}

TEST(NewMenisci, SettleByTheRowsThatAreSolved) {
  auto lengths = slack_menisci(raised_reference());
  const std::string name = "meniscus_medial_posterior";
  ResultTable poses;
  poses.add_column(name + ".length_mm");
  poses.add_row();
  EXPECT_FALSE(settle_menisci(poses, lengths)) << "there is none";
  EXPECT_EQ(lengths.at("length of " + name), "slack_length = 184.61");
  poses.add_row();
  poses.set(name + ".length_mm", 42.0);
  EXPECT_TRUE(settle_menisci(poses, lengths));
  EXPECT_EQ(lengths.at("length of " + name), "slack_length = 40.98");
}

}  // namespace
}  // namespace genu
