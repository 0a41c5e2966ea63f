#include "genu/new_scene/new_aims.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/assemble/with_numbers.h"
#include "genu/new_scene/tolerances.h"
#include "support/bundled_knee.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

Eigen::Index aim_called(const std::string& words) {
  const auto& aims = new_knee_aims();
  for (std::size_t k = 0; k < aims.size(); ++k)
    if (aims[k].words == words) return static_cast<Eigen::Index>(k);
  ADD_FAILURE() << words;
  return 0;
}

Aims none() { return VecX::Zero(static_cast<Eigen::Index>(new_knee_aims().size())); }

NewKneeLaxity whole_knee() {
  NewKneeLaxity knee;
  knee.complete = 12, knee.cut_complete = 32;
  return knee;
}

/// A value that one aim changes.
NewKneeLaxity::Value value(double now, double least, double most, Eigen::Index aim, double rate) {
  NewKneeLaxity::Value v{now, least, most, 0.5e-3, none()};
  v.rates[aim] = rate;
  return v;
}

TEST(NewAims, OfAUsualKneeGoBackToNothing) {
  NewKneeLaxity knee = whole_knee();
  knee.values.push_back(value(5e-3, 2e-3, 10e-3, 0, 0.1));
  EXPECT_LT(next_aims(knee, none(), 1).norm(), 1e-9);
  Aims aims = none();
  aims[aim_called("strain of the LCL")] = 0.01;
  EXPECT_LT(next_aims(knee, aims, 1).norm(), 1e-6);
}

TEST(NewAims, BringWhatIsOutsideToItsMargin) {
  const Eigen::Index acl = aim_called("strain of the ACL");
  NewKneeLaxity knee = whole_knee();
  knee.values.push_back(value(1.8e-3, 2e-3, 10e-3, acl, -0.2));
  const Aims aims = next_aims(knee, none(), 5);
  EXPECT_NEAR(1.8e-3 - 0.2 * aims[acl], 2.5e-3, 0.02e-3) << "that much its weight holds it back";
  EXPECT_LT(aims[acl], 0);
  EXPECT_NEAR(aims.norm(), std::abs(aims[acl]), 1e-9);
}

TEST(NewAims, StayWithinTheirBoundsAndTheirReach) {
  const Eigen::Index lcl = aim_called("strain of the LCL"), stiff = aim_called("stiffness of the PCL");
  NewKneeLaxity knee = whole_knee();
  knee.values.push_back(value(30e-3, 2e-3, 10e-3, lcl, -0.2));
  knee.values.push_back(value(30e-3, 2e-3, 10e-3, stiff, -0.02));
  const Aims one = next_aims(knee, none(), 0.5);
  EXPECT_NEAR(one[lcl], 0.5 * kUsualStrain, 1e-12);
  EXPECT_NEAR(one[stiff], 0.5 * kUsualStiffness, 1e-12);
  const Aims far = next_aims(knee, none(), 50);
  EXPECT_NEAR(far[lcl], kMostTightened, 1e-12);
  EXPECT_NEAR(far[stiff], std::log(kStiffestLigaments), 1e-12);
}

/// Where curves end there is no derivative to follow.
TEST(NewAims, TightenAKneeWhoseCurvesEnd) {
  NewKneeLaxity knee = whole_knee();
  knee.cut_complete = 31;
  knee.values.push_back(value(std::nan(""), 2e-3, 10e-3, 0, 0));
  const Aims aims = next_aims(knee, none(), 1);
  EXPECT_GT(aims[aim_called("strain of the LCL")], 0);
  EXPECT_GT(aims[aim_called("stiffness of the menisci")], 0);
  EXPECT_EQ(aims[aim_called("strain of the posterior capsule")], 0);
}

TEST(NewAims, WhatWasChangedIsSaid) {
  EXPECT_EQ(text_of(none()), "");
  Aims aims = none();
  aims[aim_called("strain of the ACL")] = -0.012;
  aims[aim_called("strain of the LCL")] = 0.0002;
  aims[aim_called("stiffness of the PCL")] = std::log(1.44);
  EXPECT_EQ(text_of(aims), "strain of the ACL -1.2 %, stiffness of the PCL times 1.44");
}

TEST(NewAims, LeaveAKneeAsItIsWhenTheyAreStopped) {
  const test::TemporaryFolder folder;
  Diagnostics out;
  const auto prepared = prepare(folder.write("scene.toml", test::bundled_knee()), out);
  ASSERT_TRUE(prepared) << test::messages(out);
  EXPECT_TRUE(aim_at_ranges(*prepared, [] { return true; }).aims.isZero());
}

/// Rotation and the anterior drawer are too large without them. What is said is what the numbers give.
TEST(NewAims, BringAKneeIntoTheRanges) {
  const test::TemporaryFolder folder;
  Diagnostics out;
  const auto prepared = prepare(folder.write("scene.toml", test::bundled_knee()), out);
  ASSERT_TRUE(prepared) << test::messages(out);
  const NewKneeLaxity before = laxity_of_new(*prepared, {}, {});
  EXPECT_FALSE(before.usual());
  EXPECT_TRUE(before.all_complete());
  const AimedKnee aimed = aim_at_ranges(*prepared, {});
  EXPECT_TRUE(aimed.laxity.usual()) << aimed.laxity.text() << "; " << text_of(aimed.aims);
  std::vector<NewNumber> numbers;
  for (const Parameter& p : parameters_of(prepared->source)) {
    const auto dot = p.name.find('.');
    const std::string fibre = p.name.substr(0, dot);
    if (p.kind == Parameter::Kind::slack_length && aimed.slack.contains(fibre))
      numbers.emplace_back(p, aimed.slack.at(fibre));
    if (p.name.ends_with(".stiffness") && aimed.stiffness.contains(fibre))
      numbers.emplace_back(p, aimed.stiffness.at(fibre));
  }
  const auto changed = with_numbers(*prepared, numbers, out);
  ASSERT_TRUE(changed) << test::messages(out);
  const NewKneeLaxity again = laxity_of_new(*changed, {}, {});
  ASSERT_EQ(again.values.size(), aimed.laxity.values.size());
  for (std::size_t k = 0; k < again.values.size(); ++k) {
    const double then = aimed.laxity.values[k].value, now = again.values[k].value;
    EXPECT_TRUE(std::isfinite(now) ? std::abs(now - then) < 1e-9 : !std::isfinite(then)) << k << ": " << then;
  }
}

}  // namespace
}  // namespace genu
