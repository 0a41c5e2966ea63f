// genu explain TOPIC: whatever a scene can hold and a run can write has an entry; what is mistyped gets a suggestion.
#include <algorithm>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "tools/cli_scenes.h"

namespace genu::test {
namespace {

void expect_explained(const std::string& topic) {
  const Outcome o = genu("explain '" + topic + "'");
  EXPECT_EQ(o.exit_code, 0) << topic << ": " << o.err;
  EXPECT_GT(o.out.size(), topic.size() + 10) << topic;
}

/// The keys that the reader itself names where one is wrong: "(its keys: body, shape, ...)".
std::vector<std::string> keys_named(const std::string& err) {
  std::vector<std::string> keys;
  const std::size_t from = err.find("(its keys: ");
  if (from == std::string::npos) return keys;
  std::istringstream list(err.substr(from + 11, err.find(')', from) - from - 11));
  for (std::string key; std::getline(list >> std::ws, key, ',');) keys.push_back(key);
  return keys;
}

TEST(CliExplain, EveryKeyThatTheReaderKnows) {
  const TemporaryFolder folder;
  const std::string cartilage = with_first(kBall, "model = \"rigid\"", "model = \"cartilage\"");
  const std::pair<std::string, std::string> places[] = {
      {kBall, "[body.femur]"},    {kBall, "[joint.knee]"}, {kBall, "[surface.ball]"}, {kBall, "[contact.medial]"},
      {kBall, "[ligament.back]"}, {kBall, "[[step]]"},     {kBall, "format = 1"},     {cartilage, "[contact.medial]"}};
  std::set<std::string> asked;
  for (const auto& [scene, place] : places) {
    const std::string text = with_first(scene, place, place + "\nzzz = 1");
    const std::vector<std::string> keys = keys_named(genu("check " + folder.write("a.toml", text)).err);
    EXPECT_GE(keys.size(), 3u) << place;
    const std::string section = place.substr(0, place.find('.')) == "[[step]]" ? "step" : "";
    for (const std::string& key : keys)
      if (asked.insert(key).second) expect_explained(key);
  }
  EXPECT_GT(asked.size(), 40u);
}

TEST(CliExplain, EveryColumnOfResults) {
  const TemporaryFolder folder;
  ASSERT_EQ(genu("run " + folder.write("a.toml", kBall) + " --quiet --out " + (folder / "out")).exit_code, 0);
  const std::string table = read_file(folder / "out/results.csv");
  std::istringstream header(table.substr(0, table.find('\n')));
  int columns = 0;
  for (std::string column; std::getline(header, column, ','); ++columns) expect_explained(column);
  EXPECT_GT(columns, 30);
}

TEST(CliExplain, StatusesEventsTermsAndSections) {
  for (const char* topic : {"ok",
                            "no_equilibrium",
                            "over_edge",
                            "overlap",
                            "flawed_mesh",
                            "undetermined",
                            "overconstrained",
                            "chatter",
                            "snaps",
                            "turns_back",
                            "gap",
                            "limit point",
                            "ligament",
                            "ligaments",
                            "body",
                            "solver",
                            "contact.model",
                            "contact.cartilage",
                            "ligament.AAC.stiffness",
                            "cartilage",
                            "judge",
                            "error bars"})
    expect_explained(topic);
  const std::string list = genu("explain").out;
  std::istringstream lines(list);
  int topics = 0;
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("  ", 0) == 0) {
      expect_explained(line.substr(2, line.find(' ', 2) - 2));
      ++topics;
    }
  EXPECT_GT(topics, 25);
}

TEST(CliExplain, WhatIsMistypedOrNoFile) {
  const Outcome near = genu("explain stifness");
  EXPECT_EQ(near.exit_code, 2);
  EXPECT_TRUE(contains(near.err, "did you mean \"stiffness\"?")) << near.err;
  EXPECT_TRUE(contains(near.err, "what to do: `genu explain` without a word lists the topics")) << near.err;
  EXPECT_TRUE(contains(genu("explain none.toml").err, "no such file"));
  EXPECT_TRUE(contains(genu("explain ligaments").out, "transition_strain"));
  EXPECT_FALSE(contains(genu("explain ligaments").out, "](#"));
}

TEST(CliExplain, CommandsWithTheirPages) {
  for (const char* command : {"laxity", "judge", "calibrate", "evaluate", "sensitivity"}) {
    const Outcome o = genu(std::string("explain ") + command);
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_TRUE(contains(o.out, std::string(command) + " is a command: ")) << o.out;
    EXPECT_GT(std::count(o.out.begin(), o.out.end(), '\n'), 20) << command << " has a page in docs/";
  }
}

TEST(CliExplain, ChangesNeedAScene) {
  for (const char* asked :
       {"explain ligaments --without ACL", "explain laxity --set AAC.stiffness=1", "explain --set a=1"}) {
    const Outcome o = genu(asked);
    EXPECT_EQ(o.exit_code, 2) << asked;
    EXPECT_EQ(o.out, "") << asked;
    EXPECT_TRUE(contains(o.err, "--without and --set change a scene, and")) << o.err;
  }
}

TEST(CliExplain, SearchesAllPagesInFullText) {
  for (const char* word : {"pressure", "laxity", "ACL.force_N", "cut"}) {
    const Outcome o = genu(std::string("explain ") + word);
    EXPECT_EQ(o.exit_code, 0) << word << o.err;
    EXPECT_TRUE(contains(o.out, ": ")) << word;
  }
  const Outcome two = genu("explain 'smallest gap'");
  EXPECT_TRUE(contains(two.out, "The pages in docs/ that speak of it:") || contains(two.out, "More about")) << two.out;
  EXPECT_EQ(genu("explain zzzzqx").exit_code, 2);
}

TEST(CliExplain, TheFirstLinesSayWhatToDo) {
  const Outcome alone = genu("");
  for (const char* line : {"genu new knee", "--femur femur.stl --tibia tibia.stl", "genu run SCENE --out DIR",
                           "report.html", "genu explain", "genu --help"})
    EXPECT_TRUE(contains(alone.out, line)) << line;
  const std::string version = genu("--version").out;
  for (const char* part : {"CGAL", "build: ", "Eigen 3", "MPL-2.0", "Apache-2.0", "SUNDIALS"})
    EXPECT_TRUE(contains(version, part)) << part << "\n" << version;
}

}  // namespace
}  // namespace genu::test
