// The lists of tests that are left out of a run: a test that is renamed must not fall off its list, and what is said to
// be run in its place must be run.
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "style/house_rules.h"
#include "support/places.h"

namespace genu::style {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Names as "room Suite.Name", of all tests in tests/ROOM/*.cpp.
std::set<std::string> tests_in(const std::vector<SourceFile>& files) {
  static const std::regex test(R"(^TEST(_F|_P)?\((\w+), (\w+)\))"), room("^tests/(\\w+)/");
  std::set<std::string> names;
  for (const SourceFile& file : files)
    for (const std::string& line : file.lines) {
      std::smatch is, in;
      if (std::regex_search(line, is, test) && std::regex_search(file.path, in, room))
        names.insert(in.str(1) + " " + is.str(2) + "." + is.str(3));
    }
  return names;
}

/// The lines of a list in which a name is no test of its room, or is itself on the list in the place of what is run.
std::vector<std::string> wrong_lines(std::istream& list, const std::set<std::string>& tests) {
  std::vector<std::string> lines, wrong;
  std::set<std::string> left_out;
  for (std::string line; std::getline(list, line);)
    if (!line.empty() && line[0] != '#') lines.push_back(line);
  for (const std::string& line : lines) {
    std::istringstream words(line);
    std::string room, test;
    words >> room >> test;
    left_out.insert(room + " " + test);
  }
  for (const std::string& line : lines) {
    std::istringstream words(line);
    std::string room, test, runs;
    words >> room >> test;
    bool good = tests.contains(room + " " + test), any = false;
    while (words >> runs)
      any = true, good = good && tests.contains(room + " " + runs) && !left_out.contains(room + " " + runs);
    if (!good || !any) wrong.push_back(line);
  }
  return wrong;
}

TEST(TestLists, LongTestsHaveOthersInTheirPlace) {
  std::ifstream list(test::source_folder() + "/tests/long_tests.txt");
  ASSERT_TRUE(list);
  EXPECT_THAT(wrong_lines(list, tests_in(read_sources(test::source_folder(), {"tests"}))), IsEmpty());
}

TEST(TestLists, SlowTestsExist) {
  std::set<std::string> names;
  for (const std::string& test : tests_in(read_sources(test::source_folder(), {"tests"})))
    names.insert(test.substr(test.find(' ') + 1));
  std::ifstream list(test::source_folder() + "/tests/slow_tests.txt");
  ASSERT_TRUE(list);
  for (std::string line; std::getline(list, line);) {
    if (line.empty() || line[0] == '#' || line.find_first_of("/*") != std::string::npos)
      continue;  // more than one test
    EXPECT_TRUE(names.contains(line)) << line;
  }
}

TEST(TestLists, AWrongLineIsFound) {
  const std::set<std::string> tests =
      tests_in({{"tests/a/x_test.cpp", {"TEST(X, One) {", "TEST_F(X, Two) {", "TEST_P(X, Three) {"}}});
  std::istringstream list("# words\na X.One X.Two\na X.Gone X.Two\na X.Three\na X.Two X.Three\nb X.Two X.One\n");
  EXPECT_THAT(wrong_lines(list, tests),
              ElementsAre("a X.One X.Two", "a X.Gone X.Two", "a X.Three", "a X.Two X.Three", "b X.Two X.One"));
}

}  // namespace
}  // namespace genu::style
