// What a run is called in the end: doubts come first, and the exit code follows them.
#include "genu/appraise/appraise.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/crank_scene.h"
#include "support/scenes.h"

namespace genu {
namespace {

using ::testing::ElementsAre;
using Class = RunSummary::Class;

RunSummary classified(int exit_code, const std::vector<std::string>& doubts, bool doubted) {
  RunSummary s;
  s.exit_code = exit_code;
  s.verdict = {"What was found."};
  classify(doubts, doubted, s);
  return s;
}

TEST(Classify, WithoutDoubtsNothingChanges) {
  const RunSummary s = classified(kExitOk, {}, false);
  EXPECT_EQ(s.verdict_class, Class::solved);
  EXPECT_EQ(s.exit_code, kExitOk);
  EXPECT_THAT(s.verdict, ElementsAre("What was found."));
}

TEST(Classify, DoubtsOfASolvedRunComeFirst) {
  const RunSummary s = classified(kExitOk, {"the knee jumped", "the ACL tears"}, false);
  EXPECT_EQ(s.verdict_class, Class::doubtful);
  EXPECT_EQ(s.exit_code, kExitDoubtful);
  EXPECT_THAT(s.verdict, ElementsAre("Solved, but the knee jumped.", "The ACL tears.", "What was found."));
}

TEST(Classify, WhatElseIsDoubtedCountsWithoutASentence) {
  const RunSummary s = classified(kExitOk, {}, true);
  EXPECT_EQ(s.verdict_class, Class::doubtful);
  EXPECT_EQ(s.exit_code, kExitDoubtful);
  EXPECT_THAT(s.verdict, ElementsAre("What was found."));
}

TEST(Classify, DoubtsOfARunThatIsNotSolvedComeLastAndChangeNoCode) {
  const RunSummary s = classified(kExitIncomplete, {"the knee jumped"}, true);
  EXPECT_EQ(s.verdict_class, Class::not_solved);
  EXPECT_EQ(s.exit_code, kExitIncomplete);
  EXPECT_THAT(s.verdict, ElementsAre("What was found.", "The knee jumped."));
}

/// A crank that its prescription holds.
TEST(Appraise, CountsWhatWasAskedAndSolved) {
  const Solution s =
      test::solution_of(test::crank_scene("[[step]]\nprescribe = { \"hinge.angle\" = [-40, 40] }\nincrements = 4\n"));
  EXPECT_EQ(s.summary.poses_asked, 5);
  EXPECT_EQ(s.summary.poses_solved, 5);
  EXPECT_EQ(s.summary.verdict_class, Class::solved);
  EXPECT_LE(s.summary.worst_residual, 1e-10);
  EXPECT_FALSE(s.summary.partial);
}

}  // namespace
}  // namespace genu
