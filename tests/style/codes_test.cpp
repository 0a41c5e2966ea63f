// Errors by their codes: each is reported somewhere, and nobody guesses from the words of a message what is wrong.
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "genu/core/diagnostic_code.h"
#include "style/house_rules.h"
#include "support/places.h"

namespace genu::style {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::array kEnumerators = {
#define GENU_CODE(name, text, meaning) #name,
#include "genu/core/diagnostic_codes.def"
#undef GENU_CODE
};

/// Codes that no source reports.
std::vector<std::string> unused_codes(const std::vector<SourceFile>& files) {
  std::string all;
  for (const SourceFile& file : files)
    if (!file.path.ends_with("cli/advice_table.cpp"))
      for (const std::string& line : file.lines) all += line + "\n";
  std::vector<std::string> unused;
  for (const std::string name : kEnumerators)
    if (!std::regex_search(all, std::regex("Code::" + name + "\\b"))) unused.push_back(name);
  return unused;
}

/// Lines that look into the words of a diagnostic.
std::vector<std::string> tests_of_words(const std::vector<SourceFile>& files) {
  static const std::regex looks(
      R"([.>]rule\s*(==|!=|\.(r?find|starts_with|ends_with|contains|compare)\b)|holds\(\w*\.rule)");
  std::vector<std::string> found;
  for (const SourceFile& file : files)
    for (std::size_t i = 0; i < file.lines.size(); ++i)
      if (std::regex_search(file.lines[i], looks)) found.push_back(file.path + ":" + std::to_string(i + 1));
  return found;
}

TEST(Codes, AreAllReported) { EXPECT_THAT(unused_codes(read_sources(test::source_folder())), IsEmpty()); }

TEST(Codes, AreLookedUpAndWordsAreNot) {
  EXPECT_THAT(tests_of_words(read_sources(test::source_folder())), IsEmpty());
  const SourceFile guesses{"a.cpp",
                           {"if (d.rule.find(\"mesh\") == 0)", "return d.code == Code::layout;", "if (x->rule == y)",
                            "holds(problem.rule, \"mesh\")", "out.add(rule.unit_name == \"mm\")"}};
  EXPECT_THAT(tests_of_words({guesses}), ElementsAre("a.cpp:1", "a.cpp:3", "a.cpp:4"));
}

}  // namespace
}  // namespace genu::style
