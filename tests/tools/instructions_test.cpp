// Instructions that a run spends, counted by callgrind: those of effects that its scene does not name are none.
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "support/places.h"
#include "tools/cli_scenes.h"

namespace genu::test {
namespace {

/// Functions that motion over time alone calls.
const std::regex kMotion(
    "EquationsOfMotion|OdeIntegrator|MotionContacts|MotionWatch|follow_motion|solve_motion|motion_table|add_damping|"
    "damper_tension|gyroscopic_wrench|mass_matrix|centripetal_rates|^CVode|^cv[A-Z]");

/// Functions that paths over surfaces alone call: of the room `wrap`, and what asks it.
const std::regex kWraps(
    "solve_string|string_length|string_hessian|is_shortest|least_hold|line_clearance|first_string|settle_touches|"
    "solve_touches|clearance_at|genu::shoot|arc_end|arc_change|Shooter|find_touches|follow_touches|"
    "touch_margin|switch_touch|LigamentPath::Variation|LigamentPath::span_at|SideWatch::(carry|seek|excess)");

struct Instructions {
  double all = 0, of_effect = 0;
};

/// Sums the self cost of a callgrind profile: "fn=(id) name" opens a function, lines that begin with a number (or + -
/// *) are its cost; the line after "calls=" is the cost of what it calls.
Instructions read_profile(const std::string& file, const std::regex& effect) {
  std::ifstream in(file);
  std::map<std::string, bool> known;
  Instructions out;
  bool counts = false, called = false;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("fn=(", 0) == 0) {
      const std::size_t end = line.find(')');
      const std::string id = line.substr(4, end - 4);
      if (end + 1 < line.size()) known[id] = std::regex_search(line.substr(end + 2), effect);
      counts = known[id];
    } else if (line.rfind("cfn=(", 0) == 0) {
      const std::size_t end = line.find(')');
      if (end + 1 < line.size()) known[line.substr(5, end - 5)] = std::regex_search(line.substr(end + 2), effect);
    } else if (line.rfind("calls=", 0) == 0) {
      called = true;
    } else if (!line.empty() && std::string("0123456789+-*").find(line[0]) != std::string::npos) {
      std::istringstream words(line);
      std::string place;
      double cost = 0;
      words >> place >> cost;
      if (!called) (counts ? out.of_effect : out.all) += cost;
      called = false;
    }
  }
  out.all += out.of_effect;
  return out;
}

Instructions instructions(const std::string& scene, const std::regex& effect) {
  const TemporaryFolder folder;
  const std::string profile = folder / "profile";
  const int status =
      std::system(("valgrind --tool=callgrind --callgrind-out-file=" + profile + " " + genu::test::program() + " run " +
                   scene + " --no-report" + " --quiet --out " + (folder / "out") + " >/dev/null 2>&1")
                      .c_str());
  EXPECT_EQ(status, 0);
  return read_profile(profile, effect);
}

bool has_valgrind() { return std::system("valgrind --version >/dev/null 2>&1") == 0; }

TEST(Instructions, AKneeInEquilibriumSpendsNoneOnMotion) {
  if (!has_valgrind()) GTEST_SKIP() << "valgrind is not installed";
  const Instructions knee = instructions(genu::test::source_folder() + "/meshes/dortmans1984/scene.toml", kMotion);
  EXPECT_GT(knee.all, 1e7);
  EXPECT_EQ(knee.of_effect, 0) << "of " << knee.all;
}

TEST(Instructions, AKneeInMotionIsSeenToSpendThem) {
  if (!has_valgrind()) GTEST_SKIP() << "valgrind is not installed";
  const TemporaryFolder folder;
  std::string text = read_file(genu::test::source_folder() + "/meshes/leskovar2019/scene.toml");
  text = std::regex_replace(text, std::regex("duration = [0-9.]+"), "duration = 1.5");
  const Instructions knee = instructions(folder.write("scene.toml", text), kMotion);
  EXPECT_GT(knee.of_effect, 0.02 * knee.all) << "of " << knee.all;
}

TEST(Instructions, AKneeWithStraightLigamentsSpendsNoneOnWraps) {
  if (!has_valgrind()) GTEST_SKIP() << "valgrind is not installed";
  const Instructions knee = instructions(genu::test::source_folder() + "/meshes/dortmans1984/scene.toml", kWraps);
  EXPECT_GT(knee.all, 1e7);
  EXPECT_EQ(knee.of_effect, 0) << "of " << knee.all;
}

TEST(Instructions, ACordRoundARodIsSeenToSpendThem) {
  if (!has_valgrind()) GTEST_SKIP() << "valgrind is not installed";
  const Instructions crank =
      instructions(genu::test::source_folder() + "/tests/hard_cases/wraps/wound_beyond_half_a_turn.toml", kWraps);
  EXPECT_GT(crank.of_effect, 1e5) << "of " << crank.all;
}

}  // namespace
}  // namespace genu::test
