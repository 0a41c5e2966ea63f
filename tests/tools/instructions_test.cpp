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
bool belongs_to_motion(const std::string& function) {
  static const std::regex names(
      "EquationsOfMotion|OdeIntegrator|MotionContacts|MotionWatch|follow_motion|solve_motion|motion_table|add_damping|"
      "damper_tension|gyroscopic_wrench|mass_matrix|centripetal_rates|^CVode|^cv[A-Z]");
  return std::regex_search(function, names);
}

struct Instructions {
  double all = 0, of_motion = 0;
};

/// Sums the self cost of a callgrind profile: "fn=(id) name" opens a function, lines that begin with a number (or + -
/// *) are its cost; the line after "calls=" is the cost of what it calls.
Instructions read_profile(const std::string& file) {
  std::ifstream in(file);
  std::map<std::string, bool> known;
  Instructions out;
  bool motion = false, called = false;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("fn=(", 0) == 0) {
      const std::size_t end = line.find(')');
      const std::string id = line.substr(4, end - 4);
      if (end + 1 < line.size()) known[id] = belongs_to_motion(line.substr(end + 2));
      motion = known[id];
    } else if (line.rfind("cfn=(", 0) == 0) {
      const std::size_t end = line.find(')');
      if (end + 1 < line.size()) known[line.substr(5, end - 5)] = belongs_to_motion(line.substr(end + 2));
    } else if (line.rfind("calls=", 0) == 0) {
      called = true;
    } else if (!line.empty() && std::string("0123456789+-*").find(line[0]) != std::string::npos) {
      std::istringstream words(line);
      std::string place;
      double cost = 0;
      words >> place >> cost;
      if (!called) (motion ? out.of_motion : out.all) += cost;
      called = false;
    }
  }
  out.all += out.of_motion;
  return out;
}

Instructions instructions(const std::string& scene) {
  const TemporaryFolder folder;
  const std::string profile = folder / "profile";
  const int status =
      std::system(("valgrind --tool=callgrind --callgrind-out-file=" + profile + " " + genu::test::program() + " run " +
                   scene + " --no-report" + " --quiet --out " + (folder / "out") + " >/dev/null 2>&1")
                      .c_str());
  EXPECT_EQ(status, 0);
  return read_profile(profile);
}

bool has_valgrind() { return std::system("valgrind --version >/dev/null 2>&1") == 0; }

TEST(Instructions, AKneeInEquilibriumSpendsNoneOnMotion) {
  if (!has_valgrind()) GTEST_SKIP() << "valgrind is not installed";
  const Instructions knee = instructions(genu::test::source_folder() + "/meshes/dortmans1984/scene.toml");
  EXPECT_GT(knee.all, 1e7);
  EXPECT_EQ(knee.of_motion, 0) << "of " << knee.all;
}

TEST(Instructions, AKneeInMotionIsSeenToSpendThem) {
  if (!has_valgrind()) GTEST_SKIP() << "valgrind is not installed";
  const TemporaryFolder folder;
  std::string text = read_file(genu::test::source_folder() + "/meshes/leskovar2019/scene.toml");
  text = std::regex_replace(text, std::regex("duration = [0-9.]+"), "duration = 1.5");
  const Instructions knee = instructions(folder.write("scene.toml", text));
  EXPECT_GT(knee.of_motion, 0.02 * knee.all) << "of " << knee.all;
}

}  // namespace
}  // namespace genu::test
