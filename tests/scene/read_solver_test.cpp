#include "scene/scene_text.h"

namespace genu::scene_test {
namespace {

const std::string kSolver = "\n[solver]\ntolerance = ";

TEST(ReadSolver, ToleranceOrItsDefault) {
  Diagnostics out;
  EXPECT_EQ(parse_scene(kGoodScene, "s", out)->solver.tolerance, 1e-12);
  EXPECT_EQ(parse_scene(kGoodScene + "[solver]\n", "s", out)->solver.tolerance, 1e-12);
  for (const auto& [text, value] :
       std::vector<std::pair<std::string, double>>{{"1e-10", 1e-10}, {"1e-14", 1e-14}, {"2.5E-11", 2.5e-11}}) {
    const auto scene = parse_scene(kGoodScene + kSolver + text + "\n", "s", out);
    ASSERT_TRUE(scene) << all_messages(out);
    EXPECT_EQ(scene->solver.tolerance, value);
  }
  EXPECT_TRUE(out.items().empty()) << all_messages(out);
}

/// Looser ones are said to count as the loosest that contacts and events allow.
TEST(ReadSolver, LooseTolerancesCountAsTheLoosest) {
  for (const auto& [text, shown] :
       std::vector<std::pair<std::string, std::string>>{{"1.1e-10", "1.1e-10"}, {"1e-8", "1e-08"}, {"1e-3", "0.001"}}) {
    Diagnostics out;
    const auto scene = parse_scene(kGoodScene + kSolver + text + "\n", "s", out);
    ASSERT_TRUE(scene) << all_messages(out);
    EXPECT_EQ(scene->solver.tolerance, 1e-10);
    ASSERT_EQ(out.items().size(), 1U) << all_messages(out);
    EXPECT_FALSE(out.has_errors());
    const std::string said = all_messages(out);
    EXPECT_NE(said.find("solver.tolerance"), std::string::npos) << said;
    EXPECT_NE(said.find(shown + ": counts as 1e-10"), std::string::npos) << said;
  }
}

void expect_solver_refused(const std::string& lines, const std::string& key, const std::string& found,
                           const std::string& rule) {
  SCOPED_TRACE(lines);
  expect_one_error(kGoodScene + lines + "\n", key, found, rule);
}

TEST(ReadSolver, Errors) {
  const std::string key = "solver.tolerance", range = "must be from 1e-14 to 0.001";
  expect_solver_refused(kSolver + "@0.002", key, "0.002", range);
  expect_solver_refused(kSolver + "@9e-15", key, "9e-15", range);
  expect_solver_refused(kSolver + "@1", key, "1", range);
  expect_solver_refused(kSolver + "@0", key, "0", "must be > 0");
  expect_solver_refused(kSolver + "@-1e-8", key, "-1e-08", "must be > 0");
  expect_solver_refused(kSolver + "@nan", key, "nan", "finite");
  expect_solver_refused(kSolver + "@\"1e-8\"", key, "\"1e-8\"", "must be a number");
  expect_solver_refused("[solver]\n@tolerence = 1e-8", "solver.tolerence", "1e-08", "did you mean \"tolerance\"?");
  expect_one_error(edited("format = 1", "format = 1\nsolver = @1e-8"), "solver", "1e-08", "must be a table");
}

TEST(ReadSolver, NotOfAMotion) {
  const std::string swing = R"(format = 1
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
[body.link]
mass = 2
inertia = [0.03, 0.02, 0.04]
[joint.h]
type = "revolute"
parent = "ground"
child = "link"
axis = [0, 0, 1]
[dynamics]
duration = 2
output_interval = 0.5
)";
  expect_one_error(swing + "[@solver]\ntolerance = 1e-8\n", "solver", "", "a tolerance of its own in [dynamics]");
}

}  // namespace
}  // namespace genu::scene_test
