// The sentences of meshes/dortmans1984/SOURCE.md, and that its tables are those of this build.
#include "studies/dortmans_study.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/places.h"
#include "support/scenes.h"
#include "validation/study_files.h"

namespace genu::studies {
namespace {

const std::string kDortmansFolder = genu::test::source_folder() + "/meshes/dortmans1984";

const std::vector<DortmansReading>& readings() {
  static const std::vector<DortmansReading> solved = [] {
    Diagnostics out;
    return solve_dortmans(kDortmansFolder, out);
  }();
  return solved;
}

/// From the first degree on: within it the spring of the first reading shortens by 2e-4.
bool rises(const std::vector<double>& values, double sign) {
  return std::is_sorted(values.begin() + 1, values.end(), [&](double x, double y) { return sign * x < sign * y; });
}

TEST(DortmansStudy, BothReadingsAreSolvedAndStableThroughout) {
  ASSERT_EQ(readings().size(), 2u);
  for (const DortmansReading& r : readings()) {
    EXPECT_TRUE(r.all_stable) << r.scene;
    EXPECT_EQ(r.flexion.size(), 71u) << r.scene;
    for (const ContactShift& s : r.shifts) EXPECT_EQ(s.femur.size(), 71u) << r.scene << " " << s.name;
  }
}

TEST(DortmansStudy, TheFemurExorotatesALittle) {
  ASSERT_EQ(readings().size(), 2u);
  const double most[] = {2.25, 3.47};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& turn = readings()[k].exorotation;
    const auto peak = std::max_element(turn.begin(), turn.end());
    EXPECT_NEAR(*peak, most[k], 0.03);
    EXPECT_TRUE(std::is_sorted(turn.begin(), peak));
    EXPECT_GE(peak - turn.begin(), 40);
    EXPECT_LE(peak - turn.begin(), 55);
    EXPECT_GT(turn.back(), *peak - 1);
    EXPECT_GE(*std::min_element(turn.begin(), turn.end()), 0);
  }
}

TEST(DortmansStudy, TheAnteriorCruciatesFrontStretchesAndItsBackShortens) {
  ASSERT_EQ(readings().size(), 2u);
  const double front[] = {0.0478, 0.0468}, back[] = {-0.0867, -0.1095};
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(readings()[k].anterior_strain.back(), front[k], 1e-4);
    EXPECT_NEAR(readings()[k].posterior_strain.back(), back[k], 1e-4);
    EXPECT_TRUE(rises(readings()[k].anterior_strain, 1));
    EXPECT_TRUE(rises(readings()[k].posterior_strain, -1));
  }
}

TEST(DortmansStudy, ContactsRollFirstAndSlideMoreAndMore) {
  ASSERT_EQ(readings().size(), 2u);
  const double sagittal[] = {20, 15};
  for (std::size_t k = 0; k < 2; ++k) {
    for (const ContactShift& s : readings()[k].shifts) {
      // The condyle turns under its axis: its contact goes once round by the flexion, whatever else happens.
      EXPECT_NEAR(1e3 * s.femur.back(), sagittal[k] * 70 * M_PI / 180, 0.1) << s.name;
      EXPECT_GT(s.tibia.back(), 0.011) << s.name;
      EXPECT_LT(s.tibia.back(), 0.0185) << s.name;
      const double first = sliding_share(s, 0, 10), last = sliding_share(s, 60, 70);
      EXPECT_LT(first, 0.25) << s.name;
      EXPECT_GT(last, 0.36) << s.name;
      EXPECT_LT(last, 0.72) << s.name;
      // Over the whole path rolling prevails.
      EXPECT_LT(sliding_share(s, 0, 70), 0.5) << s.name;
      fmt::print("  {:<8} sliding over the first 10 deg {:.3f}, the last {:.3f}, all {:.3f}\n", s.name, first, last,
                 sliding_share(s, 0, 70));
      if (k == 1 && s.name == "lateral") continue;  // it first runs ahead on the tibia
      for (std::size_t row = 20; row <= 70; row += 10)
        EXPECT_GT(sliding_share(s, row - 10, row), sliding_share(s, row - 20, row - 10)) << s.name << " " << row;
    }
  }
}

TEST(DortmansStudy, BeyondSeventyDegreesTheMomentFalls) {
  Diagnostics out;
  auto driven = read_scene(kDortmansFolder + "/scene-moment.toml", out),
       flexed = read_scene(kDortmansFolder + "/scene.toml", out);
  ASSERT_TRUE(driven && flexed) << test::messages(out);
  flexed->steps[0].prescribe[0].to = 200 * M_PI / 180;
  flexed->steps[0].increments = 200;
  const Solution moment = test::solved(*driven), flexion = test::solved(*flexed);
  EXPECT_EQ(moment.summary.exit_code, kExitOk);
  EXPECT_EQ(flexion.summary.exit_code, kExitDoubtful) << "beyond the end of the path it snaps, and goes on";
  const auto first = [](const Solution& s, PathEvent::Kind kind) {
    const auto e = std::find_if(s.events.begin(), s.events.end(), [&](const PathEvent& x) { return x.kind == kind; });
    return e == s.events.end() ? PathEvent{} : *e;
  };
  const PathEvent limit = first(moment, PathEvent::Kind::limit_point),
                  peak = first(flexion, PathEvent::Kind::reaction_turns),
                  end = first(flexion, PathEvent::Kind::snapped);
  ASSERT_FALSE(limit.coordinates.empty() || peak.coordinates.empty() || end.coordinates.empty());
  EXPECT_NEAR(limit.target.load_factors[0], 0.5745, 5e-5);
  for (const PathEvent& e : {limit, peak}) EXPECT_NEAR(e.coordinates[0][0] * 180 / M_PI, 80.9312789, 1e-6);
  EXPECT_NEAR(end.coordinates[0][0] * 180 / M_PI, 196.2, 0.05);
  // Not the same knee after that: it has turned over.
  const PathEvent beyond = first(flexion, PathEvent::Kind::new_branch);
  EXPECT_GT(std::abs(beyond.coordinates[0][1] - end.coordinates[0][1]) * 180 / M_PI, 90);
  const ResultTable& t = flexion.poses;
  for (std::size_t row = 0; row < 197; ++row) {
    const double degrees = t.number(row, "knee.flexion_deg"), held = t.number(row, "knee.flexion.reaction_Nm");
    EXPECT_EQ(test::word(t, row, "stability"), "stable") << degrees;
    if (degrees > 81.5) {
      const bool flexes_itself = degrees > 106.4 && degrees < 127.1;
      EXPECT_EQ(held < 0, flexes_itself) << degrees;
    }
    int pulling = 0;
    for (const char* name : {"AAC", "PAC", "APC", "PPC", "LC", "AMC", "PMC"})
      pulling += t.number(row, std::string(name) + ".force_N") > 0 ? 1 : 0;
    if (degrees > 119.5 && degrees < 140.5) {
      EXPECT_EQ(pulling, 3) << degrees;
    }
  }
  EXPECT_NEAR(t.number(128, "knee.adduction_deg"), 8, 0.5);
  EXPECT_NEAR(t.number(140, "knee.adduction_deg"), 18.5, 0.05);
}

TEST(DortmansStudy, TheTablesInTheFolderAreThoseOfThisBuild) {
  test::expect_same_files(kDortmansFolder, dortmans_files(readings()));
}

}  // namespace
}  // namespace genu::studies
