// Numbers drawn by lot do not depend on the compiler: the arguments of a call are evaluated in any order (GCC goes from
// the right, Clang from the left), so no call draws twice. Braces and separate declarations have an order.
#include <cctype>
#include <regex>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "style/house_rules.h"
#include "support/places.h"

namespace genu::style {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Whether two arguments of one call draw, words in quotes left out.
bool draws_twice_in_a_call(const std::string& source) {
  static const std::regex draw(R"(\w+\((random|rng|engine|generator|engine_)\)|random\.\w+\()"), quoted(R"("[^"]*")");
  const std::string line = std::regex_replace(source, quoted, "");
  std::set<std::size_t> draws;
  for (auto it = std::sregex_iterator(line.begin(), line.end(), draw); it != std::sregex_iterator(); ++it)
    draws.insert(static_cast<std::size_t>(it->position()));
  struct Bracket {
    bool ordered = false;  ///< braces
    bool call = false;
    bool drawn = false;  ///< in an argument that has ended
    bool draws = false;  ///< in this argument
  };
  std::vector<Bracket> open;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i], before = i > 0 ? line[i - 1] : ' ';
    if (draws.contains(i))
      for (auto b = open.rbegin(); b != open.rend() && !b->ordered; ++b) {
        if (b->call && b->drawn) return true;
        b->draws = true;
      }
    const bool names = std::isalnum(static_cast<unsigned char>(before)) != 0 || before == '_' || before == '>';
    if (c == '(' || c == '{' || c == '[') open.push_back({c != '(', names});
    if ((c == ')' || c == '}' || c == ']') && !open.empty()) open.pop_back();
    if (c == ',' && !open.empty()) open.back().drawn = open.back().drawn || open.back().draws;
  }
  return false;
}

std::vector<std::string> calls_that_draw_twice(const std::vector<SourceFile>& files) {
  std::vector<std::string> found;
  for (const SourceFile& file : files)
    for (std::size_t i = 0; i < file.lines.size(); ++i)
      if (draws_twice_in_a_call(file.lines[i])) found.push_back(file.path + ":" + std::to_string(i + 1));
  return found;
}

TEST(Draws, HaveAnOrder) {
  EXPECT_THAT(calls_that_draw_twice(read_sources(test::source_folder(), {"src", "tools", "tests"})), IsEmpty());
}

TEST(Draws, WithoutAnOrderAreNamed) {
  const SourceFile file{
      "a.cpp",
      {"const Vec3 x(in(random), in(random), 0);", "const Vec3 x{in(random), in(random), 0};",
       "double u = in(random), v = in(random);", "Vec3(random.uniform(0, 1), 2, random.uniform(3, 4))",
       "f(2 * (1 + in(random)), in(engine))", "max(in(random) + in(random), 2)"}};
  EXPECT_THAT(calls_that_draw_twice({file}), ElementsAre("a.cpp:1", "a.cpp:4", "a.cpp:5"));
}

}  // namespace
}  // namespace genu::style
