#include "genu/study/run_motion.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "support/judged.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

using test::TemporaryFolder;

const std::string kSwing = R"(format = 1
units = { length = "m", angle = "deg" }
gravity = [0, -9.81, 0]
[body.ground]
fixed = true
[body.link]
mass = 2
centre_of_mass = [0, -0.4, 0]
inertia = [0, 0, 0]
[joint.h]
type = "revolute"
parent = "ground"
child = "link"
axis = [0, 0, 1]
start = { angle = 40 }
damping = 0.001
[load.push]
on = "h.angle"
scale = { over = "time", table = [[0.2, 0], [0.4, 1], [0.5, 0]] }
[dynamics]
duration = 1
output_interval = 0.3
tolerance = 1e-8
)";

std::string content(const std::string& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

int run(const TemporaryFolder& folder, const std::string& text, const RunOptions& options, Diagnostics& out,
        Solution* solution = nullptr) {
  return test::judged_run(folder.write("scene.toml", text), folder / "out", options, out, solution);
}

TEST(RunMotion, WritesRowsAtMultiplesOfTheIntervalAndTheEnd) {
  TemporaryFolder folder;
  Diagnostics out;
  Solution s;
  EXPECT_EQ(run(folder, kSwing, {}, out, &s), kExitOk);
  ASSERT_EQ(s.poses.rows(), 5u);
  const double times[] = {0, 0.3, 2 * 0.3, 3 * 0.3, 1};
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(s.poses.number(k, "time_s"), times[k]);
  EXPECT_NEAR(s.poses.number(0, "h.angle_deg"), 40, 1e-13);
  EXPECT_EQ(s.poses.number(0, "h.angle_velocity_deg_s"), 0);
  EXPECT_GT(std::abs(s.poses.number(4, "energy.load_work_J")), 0.01);
  const std::string csv = content(folder / "out/results.csv"), json = content(folder / "out/summary.json");
  EXPECT_NE(json.find("\"evaluations\""), std::string::npos);
  EXPECT_NE(content(folder / "out/curves.svg").find("Energy [J]"), std::string::npos);
  EXPECT_EQ(run(folder, kSwing, {}, out), kExitOk);
  EXPECT_EQ(content(folder / "out/results.csv"), csv) << "the same bytes every time";
}

TEST(RunMotion, StepsDoNotDependOnTheRows) {
  TemporaryFolder folder;
  Diagnostics out;
  Solution few, many;
  run(folder, kSwing, {}, out, &few);
  std::string text = kSwing;
  text.replace(text.find("= 0.3"), 5, "= 0.1");
  run(folder, text, {}, out, &many);
  ASSERT_EQ(many.poses.rows(), 11u);
  EXPECT_EQ(few.poses.number(4, "h.angle_deg"), many.poses.number(10, "h.angle_deg"));
}

TEST(RunMotion, RefusesWhatItCannotDo) {
  TemporaryFolder folder;
  RunOptions starts;
  starts.starts = 3;
  Diagnostics out;
  EXPECT_EQ(run(folder, kSwing, starts, out), kExitRefused);
  ASSERT_EQ(out.items().size(), 1u);
  EXPECT_EQ(out.items()[0].line, 20);
  std::string massless = kSwing;
  massless.replace(massless.find("-0.4"), 4, "0");
  Diagnostics said;
  EXPECT_EQ(run(folder, massless, {}, said), kExitRefused);
  ASSERT_EQ(said.items().size(), 1u);
  EXPECT_NE(said.items()[0].rule.find("no inertia"), std::string::npos) << said.items()[0].rule;
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace
}  // namespace genu
