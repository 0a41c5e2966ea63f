#include "genu/sweep/compare_sweeps.h"

#include <gtest/gtest.h>

#include "genu/sweep/page_parts.h"
#include "genu/sweep/summary_tables.h"
#include "support/knee_scene.h"
#include "support/scenes.h"
#include "support/text.h"
#include "sweep/ball.h"

namespace genu {
namespace {

/// z = L0 (1 + F / K): half the slack length halves z, sample by sample.
class CompareSweeps : public ::testing::Test {
 protected:
  std::string solved(const test::TemporaryFolder& folder, const std::string& head, const std::string& slack_length) {
    const std::string study = test::ball_study(folder, head, test::kBallVary);
    folder.write("ball.toml",
                 test::replaced(test::kBallOnSpring, "slack_length = 10", "slack_length = " + slack_length));
    test::ran(test::ready_sweep(study), folder / "o");
    return folder / "o";
  }

  SweepTable table(const std::string& folder) {
    auto read = read_sweep_table(
        folder, [](std::string_view) {}, out_);
    EXPECT_TRUE(read) << test::messages(out_);
    return read ? *read : SweepTable{};
  }

  const test::TemporaryFolder long_, short_, other_;
  Diagnostics out_;
};

TEST_F(CompareSweeps, SamplesWithTheSameDrawsAreSubtracted) {
  const SweepTable a = table(solved(long_, "samples = 40\n", "10")), b = table(solved(short_, "samples = 40\n", "5"));
  const auto all = join_sweeps({{"long", a}, {"short", b}}, out_);
  ASSERT_TRUE(all) << test::messages(out_);
  EXPECT_EQ(all->paired, std::vector<std::string>{"short"});
  ASSERT_EQ(all->table.cases.size(), 2u);
  EXPECT_EQ(all->table.case_name(0), "long");
  EXPECT_EQ(all->table.case_name(1), "short");
  const std::vector<double> d = difference(all->table, 1, 0);
  for (std::size_t s = 0; s < d.size(); ++s) EXPECT_NEAR(d[s], -a.cases[0].kept[0][s] / 2, 1e-9);
  const ResultTable statistics = statistics_table(all->table), of_b = statistics_table(b);
  ASSERT_EQ(statistics.rows(), 9u) << "three numbers of each study, and of their difference";
  EXPECT_EQ(std::get<std::string>(statistics.at(6, 1)), "short - long");
  for (std::size_t k = 0; k < 3; ++k)
    for (const char* column : {"mean", "sd", "p5", "p95"})
      EXPECT_EQ(statistics.number(3 + k, column), of_b.number(k, column)) << column;
}

TEST_F(CompareSweeps, OtherDrawsStandSideBySideOnly) {
  const SweepTable a = table(solved(long_, "samples = 40\n", "10")),
                   b = table(solved(short_, "samples = 40\nseed = 2\n", "5"));
  const auto all = join_sweeps({{"long", a}, {"short", b}}, out_),
             three = join_sweeps({{"a", a}, {"b", b}, {"c", a}}, out_);
  ASSERT_TRUE(all && three) << test::messages(out_);
  EXPECT_TRUE(all->paired.empty());
  EXPECT_EQ(statistics_table(all->table).rows(), 6u);
  EXPECT_EQ(three->paired, std::vector<std::string>{"c"}) << "a study beside itself is paired";
  EXPECT_EQ(statistics_table(three->table).rows(), 12u);
}

TEST_F(CompareSweeps, WritesOnePage) {
  const std::string a = solved(long_, "samples = 40\n", "10"), b = solved(short_, "samples = 40\n", "5");
  EXPECT_TRUE(has_sweep({a, b}));
  EXPECT_FALSE(has_sweep({long_ / "", short_ / ""}));
  const std::string file = other_ / "compared.html";
  ASSERT_EQ(compare_sweeps({a, b}, file, out_), kExitOk) << test::messages(out_);
  const std::string page = test::read_file(file);
  EXPECT_TRUE(test::contains(page, kSweepPageMark));
  EXPECT_TRUE(test::contains(page, "have the draws of o: differences"));
  EXPECT_TRUE(test::contains(page, "<h2>Distributions</h2>"));
  EXPECT_FALSE(test::contains(page, "nan")) << page;
  EXPECT_EQ(compare_sweeps({a, b}, file, out_), kExitOk) << "its own page may be replaced";
}

TEST_F(CompareSweeps, RefusesWhatCannotStandSideBySide) {
  const auto refused = [&](const std::vector<std::string>& folders, const std::string& file, const char* said) {
    Diagnostics out;
    EXPECT_EQ(compare_sweeps(folders, file, out), kExitRefused);
    EXPECT_TRUE(test::contains(test::messages(out), said)) << test::messages(out);
  };
  const std::string a = solved(long_, "samples = 40\n", "10"), b = solved(short_, "samples = 20\n", "5");
  refused({a, b}, other_ / "c.html", "has 20 samples, and");
  refused({a, other_ / "none"}, other_ / "c.html", "none");
  refused({a, a}, other_ / "c.txt", "ends with .html");
  refused({a, b}, a + "/c.html", "lies in a study that is compared");
  refused({a, b}, other_.write("mine.html", "<p>mine</p>"), "mine.html");
  EXPECT_EQ(test::read_file(other_ / "mine.html"), "<p>mine</p>");
}

}  // namespace
}  // namespace genu
