#include "genu/sweep/summary_tables.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/sweep/pictures.h"
#include "genu/sweep/statistics.h"
#include "genu/sweep/sweep_page.h"
#include "genu/sweep/unit_cube.h"
#include "support/text.h"
#include "sweep/ball.h"

namespace genu {
namespace {

SweepTable table_of(const Sweep& s, const std::string& folder) {
  test::ran(s, folder);
  Diagnostics out;
  auto table = read_sweep_table(
      folder, [](std::string_view) {}, out);
  EXPECT_TRUE(table) << test::messages(out);
  return table ? *table : SweepTable{};
}

class BallTables : public ::testing::Test {
 protected:
  const test::TemporaryFolder folder_;
  const Sweep sweep_ =
      test::ready_sweep(test::ball_study(folder_, "samples = 200\n", test::kBallVary + R"([what_if.stiff]
set = "spring.slack_length=5"
)"));
  const SweepTable table_ = table_of(sweep_, folder_ / "o");
};

TEST_F(BallTables, DifferencesAreThoseOfTheSameSample) {
  // z = L0 (1 + F / K): half the slack length halves z, sample by sample.
  const std::vector<double> d = difference(table_, 1, 0);
  for (std::size_t s = 0; s < d.size(); ++s) EXPECT_NEAR(d[s], -table_.cases[0].kept[0][s] / 2, 1e-9);
  const ResultTable statistics = statistics_table(table_);
  ASSERT_EQ(statistics.rows(), 9u);
  EXPECT_EQ(std::get<std::string>(statistics.at(6, 1)), "stiff - as_is");
  EXPECT_NEAR(statistics.number(6, "mean"), -statistics.number(0, "mean") / 2, 1e-9);
}

TEST_F(BallTables, StiffnessAndForceExplainTheRanks) {
  const ResultTable ranks = rank_table(table_);
  EXPECT_LT(ranks.number(0, "rank_correlation"), -0.7);
  EXPECT_GT(ranks.number(1, "rank_correlation"), 0.3);
}

TEST_F(BallTables, ConvergenceEndsWithAllSamples) {
  const ResultTable c = convergence_table(table_);
  EXPECT_EQ(c.number(0, "samples"), 16);
  EXPECT_EQ(c.number(4, "samples"), 200);
  EXPECT_EQ(c.number(4, "mean"), statistics_table(table_).number(0, "mean"));
}

TEST_F(BallTables, ThePageNeedsNoNetwork) {
  const std::string page = sweep_page(table_, tables_of(table_));
  EXPECT_FALSE(test::contains(page, "src="));
  EXPECT_FALSE(test::contains(page, "href="));
  EXPECT_TRUE(test::contains(page, "Rank correlations with j.z_mm@0"));
  EXPECT_TRUE(test::contains(page, "Samples by j.z_mm@last"));
  EXPECT_TRUE(test::contains(page, "Samples that jumped"));
  EXPECT_FALSE(test::contains(page, "nan"));
}

TEST(EventProbabilities, CountSamplesBeyondALimit) {
  // z = L0 (1 + F / K) at every row.
  const test::TemporaryFolder folder;
  const SweepTable t = table_of(
      test::ready_sweep(test::ball_study(
          folder, "samples = 200\n",
          test::kBallVary + "[event.long]\nwhen = \"j.z_mm > 10.5\"\n[event.short]\nwhen = \"j.z < 10.5\"\nat = 7.5\n"
                            "[what_if.free]\nwithout = \"pull\"\n")),
      folder / "o");
  ASSERT_EQ(t.record.events.size(), 2u);
  EXPECT_EQ(t.record.kept.size(), 4u);  // the study's three, and the largest z
  const ResultTable events = event_probabilities(t);
  ASSERT_EQ(events.rows(), 12u);
  double above = 0;
  for (std::size_t s = 0; s < 200; ++s) above += 10 * (1 + t.draws[1][s] / (1000 * t.draws[0][s])) > 10.5 ? 1 : 0;
  EXPECT_GT(above, 50);
  EXPECT_EQ(std::get<std::string>(events.at(4, 2)), "long");
  EXPECT_EQ(events.number(4, "count"), above);
  EXPECT_EQ(events.number(5, "count"), 200 - above);
  EXPECT_EQ(events.number(5, "n"), 200);
  EXPECT_LT(events.number(4, "low"), above / 200);
  EXPECT_GT(events.number(4, "high"), above / 200);
}

TEST(EventProbabilities, LeaveOutWhatIsNotKnown) {
  SweepTable t;
  t.record.samples = 3;
  t.record.cases = {{"s", "as_is"}};
  t.record.kept = {{"a", "a", false, 0}, {"b", "b", false, 0}};
  t.record.events = {{"any", {0, 1}, true, 1}};
  t.cases.push_back({{"solved", "solved", "not_solved"}, {"", "", ""}, {0, 0, 0}, {0, 0, 0}, {}});
  t.cases[0].kept = {{0, 2, kNoNumber}, {kNoNumber, kNoNumber, kNoNumber}};
  const ResultTable events = event_probabilities(t);
  EXPECT_EQ(events.number(4, "n"), 2);  // a case without a ligament lacks its columns alone
  EXPECT_EQ(events.number(4, "count"), 1);
}

TEST(Histograms, MoveWithTheSlider) {
  const test::TemporaryFolder folder;
  const std::string study = test::ball_study(folder, "samples = 40\n", test::kBallVary);
  folder.write("study.toml", test::with_first(test::read_file(study), "[0, 7.5, \"last\"]", "\"all\""));
  const SweepTable t = table_of(test::ready_sweep(study), folder / "o");
  const std::string page = sweep_page(t, tables_of(t));
  EXPECT_TRUE(test::contains(page, "max=\"2\" value=\"1\"")) << "three values of the main coordinate";
  EXPECT_TRUE(test::contains(page, "data-h='{\"x\":[0,5,10],"));
  EXPECT_EQ(test::occurrences(page, "class=\"b\""), 30);
  EXPECT_FALSE(test::contains(page, "Samples by j.z_mm@")) << "one chart of a column";
}

TEST(Pictures, BandsNeedThreeValues) {
  const test::TemporaryFolder folder;
  const std::string study = test::ball_study(folder, "samples = 40\n", test::kBallVary);
  folder.write("study.toml", test::with_first(test::read_file(study), "[0, 7.5, \"last\"]", "\"all\""));
  const SweepTable t = table_of(test::ready_sweep(study), folder / "o");
  ASSERT_EQ(columns_with_bands(t), std::vector<std::string>{"j.z_mm"});
  EXPECT_EQ(test::occurrences(bands_picture(t, tables_of(t), "ball", "j.z_mm"), "fill-opacity:0."), 2);
  EXPECT_EQ(pictured_numbers(t, tables_of(t)).size(), 1u);
}

TEST(Intervals, AreThoseOfRandomDesigns) {
  const test::TemporaryFolder folder;
  for (const char* design : {"factorial", "one_at_a_time"}) {
    const std::string head = std::string("design = \"") + design + "\"\n";
    const SweepTable t =
        table_of(test::ready_sweep(test::ball_study(folder, head, test::kBallVary)), folder / std::string(design));
    const ResultTable statistics = statistics_table(t), events = event_probabilities(t), ranks = rank_table(t);
    for (const char* end : {"mean_low", "mean_high", "p50_low", "p50_high"})
      EXPECT_TRUE(std::isnan(statistics.number(0, end))) << end;
    for (const char* end : {"low", "high"}) {
      EXPECT_TRUE(std::isnan(events.number(0, end)));
      EXPECT_TRUE(std::isnan(ranks.number(0, end)));
    }
    EXPECT_TRUE(std::isfinite(statistics.number(0, "mean")));
    EXPECT_TRUE(std::isfinite(statistics.number(0, "p95")));
    EXPECT_EQ(events.number(0, "probability"), 0);
    EXPECT_TRUE(std::isfinite(ranks.number(0, "rank_correlation")));
    EXPECT_FALSE(test::contains(sweep_page(t, tables_of(t)), "95 % intervals"));
  }
}

TEST(IndexTable, IsOfSaltellisScheme) {
  // z - L0 is a product of independent factors: first indices and the interaction follow from their variations.
  const test::TemporaryFolder folder;
  const Sweep s = test::ready_sweep(
      test::ball_study(folder, "samples = 1024\nindices = true\ndesign = \"sobol\"\n", test::kBallVary));
  const ResultTable t = index_table(table_of(s, folder / "o"));
  ASSERT_EQ(t.rows(), 6u);
  const double force = 20.0 * 20 / 12 / (50.0 * 50), compliance = 0.2 * 0.2;  // squared coefficients of variation
  const double all = (1 + force) * (1 + compliance) - 1;
  EXPECT_NEAR(t.number(0, "first"), compliance / all, 0.03);
  EXPECT_NEAR(t.number(1, "first"), force / all, 0.03);
  EXPECT_NEAR(t.number(0, "total"), compliance * (1 + force) / all, 0.03);
}

/// A table of Saltelli's scheme without a scene: the first of `factors` uniform numbers is the kept number.
SweepTable saltelli_table(std::uint64_t seed, std::uint64_t blocks, std::uint32_t factors) {
  SweepTable t;
  t.record.block = factors + 2;
  t.record.samples = blocks * t.record.block;
  t.record.cases = {{"s", kAsItIs}};
  t.record.kept = {{"y", "y", false, 0}};
  t.record.factors = {"x"};
  t.draws.resize(1);
  t.cases.resize(1);
  t.cases[0].kept.resize(1);
  for (std::uint64_t s = 0; s < t.record.samples; ++s) {
    const std::uint64_t member = s % t.record.block;
    const double x = monte_carlo_coordinate(seed, s / t.record.block, member == 1 || member == 2 ? factors : 0);
    t.draws[0].push_back(x);
    t.cases[0].kept[0].push_back(x);
    t.cases[0].classes.emplace_back("solved");
    t.cases[0].jumps.push_back(x > 0.5 ? 1 : 0);
  }
  return t;
}

TEST(SaltelliTables, CountIndependentSamplesAlone) {
  // 200 sweeps of 100 blocks: 95 % intervals hold the truth within 4 standard errors of as often as they say.
  constexpr int kTimes = 200;
  const double fewest = kTimes * 0.95 - 4 * std::sqrt(kTimes * 0.95 * 0.05);
  int means = 0, jumps = 0;
  const auto has = [](const ResultTable& t, const char* low, const char* high) {
    return t.number(0, low) <= 0.5 && 0.5 <= t.number(0, high) ? 1 : 0;
  };
  for (std::uint64_t seed = 0; seed < kTimes; ++seed) {
    const SweepTable t = saltelli_table(seed, 100, 8);
    const ResultTable statistics = statistics_table(t), events = event_probabilities(t);
    EXPECT_EQ(statistics.number(0, "n"), 200);
    EXPECT_EQ(events.number(0, "n"), 200);
    EXPECT_EQ(rank_table(t).number(0, "n"), 200);
    means += has(statistics, "mean_low", "mean_high");
    jumps += has(events, "low", "high");
  }
  EXPECT_GE(means, fewest);
  EXPECT_GE(jumps, fewest);
  const ResultTable convergence = convergence_table(saltelli_table(1, 100, 8));
  EXPECT_EQ(convergence.number(convergence.rows() - 1, "samples"), 200);
}

}  // namespace
}  // namespace genu
