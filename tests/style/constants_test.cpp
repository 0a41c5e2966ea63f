// Constants of the library: a name has one value in the whole house, and what tolerances.h defines is defined nowhere
// else.
#include <map>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "style/house_rules.h"
#include "support/places.h"

namespace genu::style {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

struct Constant {
  std::string name, value, place;
  bool tolerance = false;  ///< of a tolerances.h
};

/// Numeric constants outside of classes under src/genu. units.h has a factor each way, told apart by their namespaces.
std::vector<Constant> constants_of(const std::vector<SourceFile>& files) {
  static const std::regex line_of(R"(^(\s*)(?:inline )?constexpr (?!const char|char|bool|auto)[^=(]*?(\bk[A-Z].*)$)");
  static const std::regex each(R"(\b(k[A-Z]\w*)(?:\[\w*\])? = (\{.*\}|[^,;]+))");
  std::vector<Constant> out;
  for (const SourceFile& file : files) {
    if (!file.path.starts_with("src/genu/") || file.path.ends_with("core/units.h")) continue;
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      std::smatch found;
      if (!std::regex_search(file.lines[i], found, line_of)) continue;
      const std::string all = found[2];
      for (std::sregex_iterator at(all.begin(), all.end(), each), end; at != end; ++at)
        out.push_back(
            {(*at)[1], (*at)[2], file.path + ":" + std::to_string(i + 1), file.path.ends_with("tolerances.h")});
    }
  }
  return out;
}

/// A line for each name with a second value, or with a second definition of a tolerance.
std::vector<std::string> second_values(const std::vector<SourceFile>& files) {
  std::map<std::string, Constant> known;
  std::vector<std::string> problems;
  for (const Constant& c : constants_of(files)) {
    const auto [first, fresh] = known.try_emplace(c.name, c);
    if (fresh || c.value.starts_with('"') || c.value.starts_with('{')) continue;
    const Constant& other = first->second;
    if (c.value != other.value || c.tolerance || other.tolerance)
      problems.push_back(c.name + " is " + other.value + " in " + other.place + " and " + c.value + " in " + c.place);
  }
  return problems;
}

TEST(Constants, HaveOneValueEach) {
  const auto files = read_sources(test::source_folder());
  EXPECT_GT(constants_of(files).size(), 500u);
  EXPECT_THAT(second_values(files), IsEmpty());
}

TEST(Constants, ASecondValueIsFound) {
  const SourceFile header{"src/genu/mesh/tolerances.h", {"inline constexpr double kNear = 1e-3;"}};
  const SourceFile same{"src/genu/path/a.cpp", {"  constexpr double kNear = 1e-3;  // m"}};
  const SourceFile pair{"src/genu/path/b.cpp", {"constexpr int kMost = 3, kLeast = 1;"}};
  const SourceFile other{"src/genu/path/c.cpp", {"constexpr int kLeast = 2;"}};
  EXPECT_THAT(second_values({header, same}), SizeIs(1));
  EXPECT_THAT(second_values({pair, pair}), IsEmpty());
  EXPECT_THAT(second_values({pair, other}), SizeIs(1));
}

}  // namespace
}  // namespace genu::style
