#include "genu/osim/scene_words.h"

#include <gtest/gtest.h>

#include "genu/scene/words.h"

namespace genu::osim {
namespace {

TEST(SceneWords, NumbersHaveTwelveDigitsAndNoMinusZero) {
  EXPECT_EQ(number_text(-0.0), "0");
  EXPECT_EQ(number_text(1e-17), "0");
  EXPECT_EQ(number_text(0.1 + 0.2), "0.3");
  EXPECT_EQ(point_text(Vec3(-0.0017455, 0, 0.1)), "[-1.7455, 0, 100]");
}

TEST(SceneWords, NamesAreKeysAndDiffer) {
  SceneNames names;
  EXPECT_EQ(names.of({1, 1}, "tibia_r"), "tibia_r");
  EXPECT_EQ(names.of({2, 1}, "medial edge"), "medial_edge");
  EXPECT_EQ(names.of({3, 1}, "medial.edge"), "medial_edge_2");
  EXPECT_EQ(names.of({3, 7}, "medial edge"), "medial_edge_3");  // another element of that name
  EXPECT_EQ(names.of({2, 1}, "medial edge"), "medial_edge");
  int line = 4;
  for (const char* odd : {"", "", "3rd", "-x", "a\"b", "\xc3\xa4", "a\nb"})
    EXPECT_TRUE(is_name(names.of({++line, 1}, odd))) << odd;
}

TEST(SceneWords, CoordinatesLoseTheNameOfTheirJoint) {
  EXPECT_EQ(short_coordinate("knee_flex_r", "knee_r"), "flex");
  EXPECT_EQ(short_coordinate("pf_tx_l", "pf_l"), "tx");
  EXPECT_EQ(short_coordinate("knee_flex", "knee"), "flex");
  EXPECT_EQ(short_coordinate("knee_angle_r", "walker_knee_r"), "knee_angle_r");
  EXPECT_EQ(short_coordinate("knee_r", "knee_r"), "knee_r");
}

}  // namespace
}  // namespace genu::osim
