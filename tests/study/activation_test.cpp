// `activation` of a load toward a point: a closed form, sensitivities, calibration, the judge and bad input.
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "genu/appraise/explain.h"
#include "genu/calibrate/calibrate.h"
#include "genu/study/sensitivity.h"
#include "support/judged.h"
#include "support/scenes.h"

namespace genu {
namespace {

constexpr double kArm = 0.05, kStiffness = 0.2 * 180 / M_PI;  // m, N m/rad

/// A lever of 50 mm on a spring, which a muscle pulls toward a point of the ground.
std::string lever(const std::string& muscle) {
  return R"(format = 1
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
[body.lever]
[joint.h]
type = "revolute"
parent = "ground"
child = "lever"
axis = [0, 0, 1]
stiffness = 0.2
[load.muscle]
body = "lever"
point = [0, 50, 0]
toward = { body = "ground", point = [60, 20, 0] }
)" + muscle +
         R"([[step]]
increments = 10
load = { muscle = [0.1, 1] }
)";
}

std::string muscle(double magnitude, double activation) {
  return "magnitude = " + std::to_string(magnitude) + "\nactivation = " + std::to_string(activation) + "\n";
}

class Activation : public testing::Test {
 protected:
  ResultTable run(const std::string& text) {
    Diagnostics out;
    Solution solution;
    EXPECT_EQ(test::judged_run(folder_.write("scene.toml", text), folder_ / "out", {}, out, &solution), kExitOk)
        << test::messages(out);
    return solution.poses;
  }
  test::TemporaryFolder folder_;
};

TEST_F(Activation, ScalesTheMagnitude) {
  const ResultTable poses = run(lever(muscle(400, 0.25)));
  for (std::size_t row = 0; row < poses.rows(); ++row) {
    const double angle = poses.number(row, "h.angle_deg") * M_PI / 180;
    const Vec3 from(-kArm * std::sin(angle), kArm * std::cos(angle), 0), to(0.06, 0.02, 0);
    const double force = 0.25 * 400 * poses.number(row, "muscle.factor");
    const double moment = from.cross(force * (to - from).normalized()).z();
    EXPECT_NEAR(moment, kStiffness * angle, 1e-9 * std::abs(moment));
  }
  const ResultTable weaker = run(lever("magnitude = 100\n")), idle = run(lever(muscle(400, 0)));
  EXPECT_DOUBLE_EQ(weaker.number(9, "h.angle_deg"), poses.number(9, "h.angle_deg"));
  EXPECT_EQ(idle.number(9, "h.angle_deg"), 0);
}

TEST_F(Activation, HasTheSensitivitiesOfEditedScenes) {
  for (const double activation : {0.25, 0.05}) {
    SensitivityResult r;
    Diagnostics out;
    ASSERT_EQ(run_sensitivity(folder_.write("scene.toml", lever(muscle(400, activation))), {},
                              {{"h.angle"}, {"muscle.activation"}}, {}, out, r),
              kExitOk)
        << test::messages(out);
    ASSERT_EQ(r.rows.parameters.size(), 1u);
    EXPECT_EQ(r.rows.parameters[0].unit, "1");
    EXPECT_EQ(r.rows.parameters[0].change_text, "0.01");
    constexpr double kStep = 1e-4;
    const ResultTable up = run(lever(muscle(400, activation + kStep))),
                      down = run(lever(muscle(400, activation - kStep)));
    for (std::size_t row = 0; row < up.rows(); ++row) {
      const double truth =
          0.01 * (up.number(row, "h.angle_deg") - down.number(row, "h.angle_deg")) / (2 * kStep);  // per 0.01
      EXPECT_GT(std::abs(truth), 1e-3);
      EXPECT_NEAR(r.rows.effect(row, 0, 0), truth, 1e-5 * std::abs(truth)) << activation;
    }
  }
}

TEST_F(Activation, IsFoundByCalibration) {
  run(lever(muscle(400, 0.25)));
  std::filesystem::copy_file(folder_ / "out/results.csv", folder_ / "target.csv");
  Diagnostics out;
  CalibrationResult result;
  ASSERT_EQ(run_calibration(folder_.write("start.toml", lever(muscle(400, 0.4))), folder_ / "fitted",
                            {{folder_ / "target.csv"}, {"muscle.activation"}, {"h.angle_deg"}}, {}, out, result),
            kExitOk)
      << test::messages(out);
  const auto written = read_scene(folder_ / "fitted/scene.toml", out);
  ASSERT_TRUE(written) << test::messages(out);
  EXPECT_NEAR(written->loads[0].activation, 0.25, 1e-6);
}

TEST_F(Activation, IsExplainedAndMustNotBeNegative) {
  Diagnostics out;
  const auto scene = parse_scene(lever(muscle(400, 0.25)), "scene.toml", out);
  ASSERT_TRUE(scene) << test::messages(out);
  EXPECT_NE(explain(*scene).find("toward a point of ground, 400 N, activation 0.25"), std::string::npos);
  EXPECT_FALSE(parse_scene(lever(muscle(400, -0.1)), "scene.toml", out));
  ASSERT_EQ(out.items().size(), 1u) << test::messages(out);
  EXPECT_EQ(to_string(out.items()[0]), "scene.toml:17:14: load.muscle.activation = -0.1: must be >= 0");
}

}  // namespace
}  // namespace genu
