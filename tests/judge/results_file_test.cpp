// What is no results.csv is refused with line and column, all at once, and never by a crash.
#include "genu/judge/results_file.h"

#include <cmath>

#include <gtest/gtest.h>

namespace genu::judge {
namespace {

const std::string kGood = "step,increment,status,knee.x_mm\n1,0,ok,2.5\n1,1,no_equilibrium,\n";

std::vector<Diagnostic> refusals(const std::string& text) {
  Diagnostics out;
  EXPECT_FALSE(ResultsFile::parse(text, "results.csv", out).has_value()) << text;
  return out.items();
}

TEST(ResultsFile, ReadsNumbersWordsAndNothing) {
  Diagnostics out;
  const auto table = ResultsFile::parse(kGood, "results.csv", out);
  ASSERT_TRUE(table.has_value());
  EXPECT_EQ(table->rows(), 2u);
  EXPECT_EQ(table->number(0, "knee.x_mm"), 2.5);
  EXPECT_TRUE(std::isnan(table->number(1, "knee.x_mm")));
  EXPECT_EQ(table->status(1), "no_equilibrium");
  EXPECT_EQ(table->unread(), (std::vector<std::string>{"step", "increment"}));
}

TEST(ResultsFile, NamesLineAndColumnOfEveryMistake) {
  const auto found = refusals("step,increment,status,x\n1,0,ok,nan\n1,1,ok,1e999\n1,2,ok,2.5mm\n");
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(to_string(found[0]), "results.csv:2:4: x = nan: is no finite number");
  EXPECT_EQ(found[1].line, 3);
  EXPECT_EQ(found[2].line, 4);
  EXPECT_EQ(found[2].found, "2.5mm");
}

TEST(ResultsFile, RefusesWhatIsCutOff) {
  for (std::size_t bytes = 0; bytes < kGood.size(); ++bytes) {
    Diagnostics out;
    const auto table = ResultsFile::parse(kGood.substr(0, bytes), "results.csv", out);
    // Cut at the end of a line it is a shorter table, which cannot be told.
    const bool at_an_end = bytes > 0 && kGood[bytes - 1] == '\n';
    EXPECT_EQ(table.has_value(), at_an_end) << bytes;
    EXPECT_EQ(out.has_errors(), !at_an_end) << bytes;
  }
}

TEST(ResultsFile, RefusesGarbage) {
  EXPECT_FALSE(refusals(std::string(1000, '\0')).empty());
  EXPECT_FALSE(refusals("\xff\xfe\n,,,\n").empty());
  EXPECT_FALSE(refusals("step,increment,status,step\n").empty());
  EXPECT_LE(refusals("step,increment,status\n" + std::string(100'000, '\n')).size(), 21u);
}

}  // namespace
}  // namespace genu::judge
