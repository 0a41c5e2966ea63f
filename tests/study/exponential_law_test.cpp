// The law "exponential" of a scene: closed form, slack and taut, sensitivities, the judge, and its numbers found again.
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

constexpr double kScale = 3, kExponent = 8;  // N

/// A lever of 50 mm that a moment turns against a spring and a cord, which the other way becomes slack.
std::string lever(double scale, double exponent, const std::string& moment = "[-0.2, 1]") {
  return R"(format = 1
plausible = { strain = 10 }
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
[ligament.cord]
from = { body = "ground", point = [60, 20, 0] }
to = { body = "lever", point = [0, 50, 0] }
law = "exponential"
force_scale = )" +
         std::to_string(scale) + "\nexponent = " + std::to_string(exponent) + R"(
reference_strain = 0.02
[load.turn]
on = "h.angle"
value = 8
[[step]]
increments = 20
load = { turn = )" +
         moment + " }\n";
}

class ExponentialLaw : public testing::Test {
 protected:
  Solution run(const std::string& text) {
    Diagnostics out;
    Solution solution;
    EXPECT_EQ(test::judged_run(folder_.write("scene.toml", text), folder_ / "out", {}, out, &solution), kExitOk)
        << test::messages(out);
    return solution;
  }
  test::TemporaryFolder folder_;
};

TEST_F(ExponentialLaw, PullsByItsFormulaAndIsSlackBelow) {
  const ResultTable poses = run(lever(kScale, kExponent)).poses;
  int slack = 0, taut = 0;
  for (std::size_t row = 0; row < poses.rows(); ++row) {
    const double e = poses.number(row, "cord.strain"), force = poses.number(row, "cord.force_N");
    EXPECT_NEAR(force, e > 0 ? kScale * (std::exp(kExponent * e) - 1) : 0, 1e-10 * (1 + force));
    ++(e > 0 ? taut : slack);
  }
  EXPECT_GT(slack, 2);
  EXPECT_GT(taut, 10);
}

TEST_F(ExponentialLaw, HasTheSensitivitiesOfEditedScenes) {
  SensitivityResult r;
  Diagnostics out;
  ASSERT_EQ(run_sensitivity(folder_.write("scene.toml", lever(kScale, kExponent, "[0.5, 1]")), {},
                            {{"h.angle", "cord.force"}, {"cord.force_scale", "cord.exponent"}}, {}, out, r),
            kExitOk)
      << test::messages(out);
  ASSERT_EQ(r.rows.parameters.size(), 2u);
  EXPECT_EQ(r.rows.parameters[0].unit, "N");
  EXPECT_EQ(r.rows.parameters[1].unit, "1");
  for (std::size_t k = 0; k < 2; ++k) {
    const auto with = [&](double share) {
      return run(lever(k == 0 ? kScale * (1 + share) : kScale, k == 1 ? kExponent * (1 + share) : kExponent,
                       "[0.5, 1]"))
          .poses;
    };
    const ResultTable up = with(1e-3), down = with(-1e-3);
    for (std::size_t row = 0; row < up.rows(); ++row)
      for (std::size_t o = 0; o < 2; ++o) {
        const std::string& column = r.rows.outputs[o].column;
        const double truth = (up.number(row, column) - down.number(row, column)) / 0.2;  // per 1 %
        EXPECT_NEAR(r.rows.effect(row, o, k), truth, 1e-5 * std::abs(truth) + 1e-9) << column << " " << k;
      }
  }
}

TEST_F(ExponentialLaw, HasNumbersThatCalibrationFinds) {
  run(lever(kScale, kExponent));
  std::filesystem::copy_file(folder_ / "out/results.csv", folder_ / "target.csv");
  Diagnostics out;
  CalibrationResult result;
  ASSERT_EQ(run_calibration(folder_.write("start.toml", lever(4, 6)), folder_ / "fitted",
                            {{folder_ / "target.csv"}, {"cord.exponent", "cord.force_scale"}, {"h.angle_deg"}}, {}, out,
                            result),
            kExitOk)
      << test::messages(out);
  const auto written = read_scene(folder_ / "fitted/scene.toml", out);
  ASSERT_TRUE(written) << test::messages(out);
  EXPECT_NEAR(written->ligaments[0].number("force_scale"), kScale, 1e-5);
  EXPECT_NEAR(written->ligaments[0].number("exponent"), kExponent, 1e-5);
}

TEST_F(ExponentialLaw, IsExplainedAndRefusesWhatItMustNotBe) {
  Diagnostics out;
  const auto scene = parse_scene(lever(kScale, kExponent), "scene.toml", out);
  ASSERT_TRUE(scene) << test::messages(out);
  EXPECT_NE(explain(*scene).find("laws: exponential"), std::string::npos);
  EXPECT_FALSE(parse_scene(lever(-1, 0), "scene.toml", out));
  ASSERT_EQ(out.items().size(), 2u) << test::messages(out);
  EXPECT_EQ(out.items()[0].key, "ligament.cord.force_scale");
  EXPECT_EQ(out.items()[0].line, 17);
  EXPECT_EQ(out.items()[1].key, "ligament.cord.exponent");
  EXPECT_NE(out.items()[1].rule.find("must be > 0"), std::string::npos) << out.items()[1].rule;
}

}  // namespace
}  // namespace genu
