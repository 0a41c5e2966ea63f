// The catalogue of hard cases: each is answered as it must be. That those with a safeguard fail without it is for
// tools/mutants to show.
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hard_cases/hard_cases.h"
#include "support/judged.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

const std::string kFolder = genu::test::source_folder() + "/tests/hard_cases";

const std::vector<HardCase>& all_cases() {
  static const std::vector<HardCase> cases = [] {
    Diagnostics out;
    std::vector<HardCase> found = find_hard_cases(kFolder, out);
    for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
    return found;
  }();
  return cases;
}

std::vector<HardCase> quick_cases() {
  std::vector<HardCase> quick = all_cases();
  std::erase_if(quick, [](const HardCase& c) { return c.expected.takes_long; });
  return quick;
}

// The address sanitizer takes its time; what a case may take is told for the release build.
#ifdef __SANITIZE_ADDRESS__
constexpr double kPatience = 30;
#else
constexpr double kPatience = 1;
#endif

TEST(HardCases, AreAnsweredAsTheyMustBe) {
  std::vector<HardCase> cases = quick_cases();
  for (HardCase& c : cases) c.expected.limit *= kPatience;
  const test::TemporaryFolder folder;
  HardCaseOptions options;
  options.folder = folder / "out";
  const std::vector<HardCaseOutcome> outcomes = run_hard_cases(cases, kFolder, options);
  for (const HardCaseOutcome& o : outcomes)
    for (const std::string& miss : o.misses)
      ADD_FAILURE() << o.hard_case->family << "/" << o.hard_case->name << ": " << miss;
  fmt::print("{}", to_text(outcomes));
  int judged = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "out"))
    if (entry.path().filename() == "results.csv") {
      test::expect_folder_judged_ok(entry.path().parent_path());
      ++judged;
    }
  EXPECT_GT(judged, 80) << "the others are refused";
}

TEST(HardCases, AreAtLeastEighty) {
  std::map<std::string, int> families;
  for (const HardCase& c : all_cases()) {
    ++families[c.family];
    EXPECT_FALSE(c.expected.why.empty()) << c.name;
  }
  EXPECT_GE(all_cases().size(), 80u);
  for (const auto& [family, count] : families) fmt::print("  {:<10}{:>3} cases\n", family, count);
  EXPECT_EQ(families.size(), 7u);
}

TEST(HardCases, StandInTheDocumentation) {
  std::ifstream in(genu::test::source_folder() + "/docs/hard-cases.md");
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  EXPECT_NE(text.find(to_markdown(all_cases())), std::string::npos)
      << "made anew by: build/bin/genu hard-cases --table docs/hard-cases.md";
}

}  // namespace
}  // namespace genu
