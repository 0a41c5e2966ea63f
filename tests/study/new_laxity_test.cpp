#include "genu/study/new_laxity.h"

#include <gtest/gtest.h>

#include "genu/core/units.h"
#include "genu/study/tolerances.h"

namespace genu {
namespace {

NewKneeLaxity usual_knee() {
  const double degree = 1 / to::kDegree;
  return {{3e-3, 7e-3}, {4 * degree, 8 * degree}, {20 * degree, 40 * degree}, 12};
}

TEST(NewLaxity, OfAUsualKneeNothingIsChanged) {
  NewKneeAims aims;
  EXPECT_TRUE(usual_knee().usual());
  EXPECT_FALSE(aim_at_ranges(usual_knee(), aims));
  EXPECT_EQ(
      usual_knee().text(),
      "anterior 3.0 to 7.0 mm at 134 N, varus and valgus 4.0 to 8.0 deg at 10 N m, rotation 20 to 40 deg at 5 N m");
}

TEST(NewLaxity, EachRangeHasItsRemedy) {
  NewKneeLaxity lax = usual_knee();
  lax.sideways.most = 12 / to::kDegree;
  EXPECT_FALSE(lax.usual());
  NewKneeAims aims;
  EXPECT_TRUE(aim_at_ranges(lax, aims));
  EXPECT_GT(aims.sideways, 0);
  EXPECT_GT(aims.collaterals, 1);
  EXPECT_EQ(aims.menisci, 1) << "stiff menisci hide a cut PCL";
  EXPECT_EQ(aims.anterior, 0);
  aims.sideways = kMostAim, aims.collaterals = kStiffestCollaterals;
  EXPECT_TRUE(aim_at_ranges(lax, aims));
  EXPECT_GT(aims.menisci, 1);

  NewKneeLaxity tight = usual_knee();
  tight.drawer.least = 1.8e-3;
  aims = {};
  EXPECT_TRUE(aim_at_ranges(tight, aims));
  EXPECT_GT(aims.anterior, 0);
  EXPECT_EQ(aims.menisci, 1);

  NewKneeLaxity stiff = usual_knee();
  stiff.rotation.least = 14 / to::kDegree;
  aims = {};
  EXPECT_TRUE(aim_at_ranges(stiff, aims));
  EXPECT_GT(aims.rotation, 0);
  EXPECT_EQ(aims.menisci, 1);
  aims.rotation = kMostRotationAim;  // what holds rotation is as slack as it may be
  EXPECT_TRUE(aim_at_ranges(stiff, aims));
  EXPECT_LT(aims.menisci, 1);
  stiff.sideways.most = 12 / to::kDegree;
  aims = {};
  EXPECT_TRUE(aim_at_ranges(stiff, aims));
  EXPECT_GT(aims.sideways, 0);
  EXPECT_GT(aims.rotation, 0);
}

TEST(NewLaxity, ACurveThatEndsIsALaxKnee) {
  NewKneeLaxity ended = usual_knee();
  ended.complete = 11;
  NewKneeAims aims;
  EXPECT_TRUE(aim_at_ranges(ended, aims));
  EXPECT_GT(aims.sideways, 0);
  EXPECT_NE(ended.text().find("; 11 of 12 curves complete; not all as of usual knees"), std::string::npos);
}

TEST(NewLaxity, WhatWasChangedIsSaid) {
  EXPECT_EQ(text_of({}), "");
  EXPECT_EQ(text_of({.sideways = 0.012, .collaterals = 1.44}),
            "; for it strain of the collaterals and the PCL +1.2 %, collaterals 1.44 times as stiff");
  EXPECT_EQ(text_of({.anterior = 0.008, .rotation = 0.02, .menisci = 0.71}),
            "; for it strain of the ACL -0.8 %, strain of the posterior corners -2.0 %, menisci 0.71 times as stiff");
}

TEST(NewLaxity, AimsHaveAnEnd) {
  NewKneeLaxity bad = usual_knee();
  bad.sideways.most = 20 / to::kDegree;
  bad.drawer.least = 1e-3;
  NewKneeAims aims;
  int rounds = 0;
  while (aim_at_ranges(bad, aims) && rounds < 100) ++rounds;
  EXPECT_LT(rounds, 10);
  EXPECT_EQ(aims.sideways, kMostAim);
  EXPECT_EQ(aims.anterior, kMostAim);
  EXPECT_EQ(aims.menisci, kStiffestMenisci);
  EXPECT_EQ(aims.collaterals, kStiffestCollaterals);
}

}  // namespace
}  // namespace genu
