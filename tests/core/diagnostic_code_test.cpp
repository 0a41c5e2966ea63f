#include "genu/core/diagnostic_code.h"

#include <algorithm>
#include <map>
#include <string>

#include <gtest/gtest.h>

namespace genu {
namespace {

struct Line {
  const char *name, *text, *meaning;
};
constexpr Line kLines[] = {
#define GENU_CODE(name, text, meaning) {#name, text, meaning},
#include "genu/core/diagnostic_codes.def"
#undef GENU_CODE
};

TEST(DiagnosticCode, TextIsTheNameInKebabCase) {
  for (std::size_t k = 0; k < kAllCodes.size(); ++k) {
    std::string name = kLines[k].name;
    std::replace(name.begin(), name.end(), '_', '-');
    EXPECT_EQ(to_string(kAllCodes[k]), name);
    EXPECT_TRUE(std::all_of(name.begin(), name.end(), [](char c) {
      return (c >= 'a' && c <= 'z') || c == '-' || c == '8';
    })) << name;
  }
}

TEST(DiagnosticCode, TextsAndMeaningsTellCodesApart) {
  std::map<std::string, Code> by_text, by_meaning;
  for (std::size_t k = 0; k < kAllCodes.size(); ++k) {
    EXPECT_TRUE(by_text.emplace(to_string(kAllCodes[k]), kAllCodes[k]).second) << kLines[k].text;
    EXPECT_TRUE(by_meaning.emplace(kLines[k].meaning, kAllCodes[k]).second) << kLines[k].meaning;
  }
  for (const auto& [text, code] : by_text) EXPECT_EQ(to_string(code), text);
}

}  // namespace
}  // namespace genu
