// Unknowns: values of members, their slopes and back again; groups, bounds and priors by their options.
#include "genu/calibrate/calibration_unknowns.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/scene/reader.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/text.h"
#include "support/wheel_knee.h"

namespace genu {
namespace {

class CalibrationUnknowns : public ::testing::Test {
 protected:
  std::vector<CalibrationUnknown> choose(const UnknownChoice& choice) {
    out_ = {};
    auto scene = read_scene(folder_.write("scene.toml", test::wheel_knee()), out_);
    EXPECT_TRUE(scene) << test::messages(out_);
    return scene ? choose_unknowns(*scene, choice, out_) : std::vector<CalibrationUnknown>{};
  }

  test::TemporaryFolder folder_;
  Diagnostics out_;
};

TEST_F(CalibrationUnknowns, HaveTheirSlopesAndGoBack) {
  const auto unknowns = choose({{"ahead.slack_length", "left.from.x", "sides.slack_length:together"}, {}, {}});
  ASSERT_EQ(unknowns.size(), 3u) << test::messages(out_);
  EXPECT_TRUE(unknowns[0].share);
  EXPECT_FALSE(unknowns[1].share);  // a coordinate may be 0
  EXPECT_EQ(unknowns[2].members.size(), 2u);
  for (const CalibrationUnknown& unknown : unknowns)
    for (const auto& member : unknown.members)
      for (const double u : {-0.2, 0.0, 0.3}) {
        const double h = 1e-5, difference = (unknown.value(member, u + h) - unknown.value(member, u - h)) / (2 * h);
        EXPECT_NEAR(unknown.slope(member, u), difference, 1e-8 * std::abs(difference)) << unknown.name;
        EXPECT_NEAR(unknown.u_of(member, unknown.value(member, u)), u, 1e-12) << unknown.name;
        EXPECT_NEAR(unknown.u_of_shown(unknown.shown(u)), u, 1e-12) << unknown.name;
        const double shown = (unknown.shown(u + h) - unknown.shown(u - h)) / (2 * h);
        EXPECT_NEAR(unknown.shown_slope(u), shown, 1e-8 * std::abs(shown)) << unknown.name;
      }
}

TEST_F(CalibrationUnknowns, OfOneGroupKeepTheirRatio) {
  const auto unknowns = choose({{"sides.slack_length:together"}, {}, {}});
  ASSERT_EQ(unknowns.size(), 1u) << test::messages(out_);
  EXPECT_DOUBLE_EQ(unknowns[0].shown(0), 1);
  const std::vector<NewNumber> numbers = numbers_at(unknowns, VecX::Constant(1, std::log(1.1)));
  ASSERT_EQ(numbers.size(), 2u);
  EXPECT_NEAR(unknowns[0].value(unknowns[0].members[0], std::log(1.1)), 1.1 * 0.020, 1e-15);
  EXPECT_NEAR(unknowns[0].value(unknowns[0].members[1], std::log(1.1)), 1.1 * 0.0192, 1e-15);
}

TEST_F(CalibrationUnknowns, TakeBoundsAndPriorsInTheirOwnUnit) {
  const auto unknowns =
      choose({{"ahead.slack_length"}, {"ahead.slack_length=20..30"}, {"ahead.slack_length=start~4%"}});
  ASSERT_EQ(unknowns.size(), 1u) << test::messages(out_);
  EXPECT_NEAR(unknowns[0].lower, std::log(20.0 / 25), 1e-12);
  EXPECT_NEAR(unknowns[0].upper, std::log(30.0 / 25), 1e-12);
  ASSERT_TRUE(unknowns[0].prior);
  EXPECT_NEAR(unknowns[0].prior->mean, 25, 1e-12);
  EXPECT_NEAR(unknowns[0].prior->deviation, 1, 1e-12);
}

TEST_F(CalibrationUnknowns, AreRefusedAllAtOnce) {
  choose({{"nothing.slack_length", "ahead.stiffness"}, {"ahead.stiffness=5..2"}, {"ahead.stiffness=start~x"}});
  EXPECT_TRUE(test::contains(test::messages(out_), "nothing.slack_length")) << test::messages(out_);
  choose({{"ahead.stiffness"}, {"ahead.stiffness=5..2"}, {"ahead.stiffness=start~x"}});
  EXPECT_EQ(out_.items().size(), 2u) << test::messages(out_);
  choose({{"ahead.stiffness+ahead.slack_length:together"}, {}, {}});
  EXPECT_TRUE(test::contains(test::messages(out_), "one unit")) << test::messages(out_);
}

}  // namespace
}  // namespace genu
