// Every statement of Dortmans' report in both readings (meshes/dortmans1984/FAMILY.md), and that the sets of its family
// are what that page says.
#include "studies/dortmans_family.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "genu/scene/reader.h"
#include "support/judged.h"
#include "support/places.h"
#include "support/scenes.h"
#include "validation/study_files.h"

namespace genu::studies {
namespace {

const std::string kFamilyFolder = genu::test::source_folder() + "/meshes/dortmans1984";

std::vector<bool> held(const DortmansReading& r) {
  std::vector<bool> out;
  for (const DortmansStatement& s : statements_of(r)) out.push_back(s.holds());
  return out;
}

/// Solved, exorotation, moments in extension and at 70 deg, paths alike, mainly rolling, sliding grows.
TEST(DortmansFamily, WhichStatementsTheScenesHold) {
  Diagnostics out;
  const auto readings = solve_dortmans(kFamilyFolder, out);
  ASSERT_EQ(readings.size(), 2u);
  EXPECT_EQ(held(readings[0]), (std::vector<bool>{true, true, true, true, false, true, true}));
  EXPECT_EQ(held(readings[1]), (std::vector<bool>{true, true, false, false, false, true, false}));
  EXPECT_NEAR(readings[0].moment.back(), 0.499, 1e-3);
  EXPECT_NEAR(readings[1].moment.back(), 0.250, 1e-3) << "the springs were tuned for the other reading";
}

TEST(DortmansFamily, EveryMemberHoldsEveryStatement) {
  Diagnostics out;
  const auto members = read_family(kFamilyFolder + "/family.csv", out);
  std::map<std::string, int> of;
  for (const KeptMember& m : members) {
    const auto scene = read_scene(kFamilyFolder + "/" + m.scene, out);
    ASSERT_TRUE(scene);
    ASSERT_EQ(m.set.size(), free_numbers(*scene).size());
    for (const double x : m.set) EXPECT_LE(std::abs(x), 1) << "within its bound";
    const auto solved = solve_reading(with_numbers(*scene, m.set), out);
    ASSERT_TRUE(solved);
    for (const DortmansStatement& s : statements_of(*solved))
      EXPECT_TRUE(s.holds()) << m.scene << " " << m.seed << ": " << s.words << ": " << s.measured;
    ++of[m.scene];
  }
  EXPECT_GE(of["scene.toml"], 5);
  EXPECT_GE(of["scene-outer-15.toml"], 1);
}

TEST(DortmansFamily, TheSearchLowersWhatIsMissedAndRepeatsItself) {
  Diagnostics out;
  const auto scene = read_scene(kFamilyFolder + "/scene.toml", out);
  ASSERT_TRUE(scene);
  const FamilyMember none = search_family(*scene, 0, 0), some = search_family(*scene, 0, 12),
                     again = search_family(*scene, 0, 12);
  EXPECT_LT(some.missed, 0.9 * none.missed);
  EXPECT_EQ(some.set, again.set);
}

/// M prescribed coordinates and N contacts: 3 and 2, 1 and 1, 0 and 2.
TEST(DortmansFamily, ConstraintsAndContactsChangeFromPositionToPosition) {
  Diagnostics out;
  const auto scene = read_scene(kFamilyFolder + "/scene-changing.toml", out);
  ASSERT_TRUE(scene);
  const Solution s = test::solved(*scene);
  EXPECT_EQ(s.summary.exit_code, kExitOk);
  const auto contacts = [&](std::size_t row) { return s.records[row].point.pose.state.contacts.size(); };
  for (std::size_t row = 0; row <= 10; ++row) EXPECT_EQ(contacts(row), 2u) << row;
  EXPECT_EQ(contacts(20), 1u);
  EXPECT_EQ(contacts(30), 2u);
  EXPECT_EQ(contacts(31), 2u);
  for (const auto& [row, prescribed] : {std::pair{10U, 3U}, {20U, 1U}, {31U, 0U}})
    EXPECT_EQ(s.records[row].point.target.prescribed.size(), prescribed) << row;
  for (std::size_t row = 0; row < s.poses.rows(); ++row) EXPECT_EQ(test::word(s.poses, row, "stability"), "stable");
  EXPECT_NEAR(s.poses.number(31, "knee.flexion_deg"), 42.39, 0.01);
}

TEST(DortmansFamily, ThePageInTheFolderIsThatOfThisBuild) {
  Diagnostics out;
  test::expect_same_files(kFamilyFolder, family_files(kFamilyFolder, out));
}

}  // namespace
}  // namespace genu::studies
