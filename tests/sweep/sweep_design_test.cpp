#include "genu/sweep/sweep_design.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "support/text.h"
#include "sweep/ball.h"

namespace genu {
namespace {

const std::string kTwo = R"([vary]
"spring.stiffness" = { lognormal = 1000, sd = 200 }
"pull.force.z" = { normal = 50, sd = 5 }
)";

SweepDesign design(const std::string& head, const std::string& tables = kTwo) {
  const test::TemporaryFolder folder;
  return test::ready_sweep(test::ball_study(folder, head, tables)).design;
}

std::string refusals(const std::string& head, const std::string& tables) {
  const test::TemporaryFolder folder;
  Diagnostics out;
  EXPECT_FALSE(prepare_sweep(test::ball_study(folder, head, tables), out));
  return test::messages(out);
}

TEST(SweepDesign, SamplesDoNotDependOnHowManyThereAre) {
  for (const char* kind : {"monte_carlo", "sobol"}) {
    const std::string key = std::string("design = \"") + kind + "\"\n";
    const SweepDesign few = design(key + "samples = 5\n"), many = design(key + "samples = 5000\n");
    for (std::uint64_t i = 0; i < 5; ++i) EXPECT_EQ(few.draws(i), many.draws(i));
    EXPECT_NE(few.draws(0), design(key + "samples = 5\nseed = 2\n").draws(0));
  }
}

TEST(SweepDesign, CorrelatesNormalScores) {
  const SweepDesign d = design("samples = 20000\n", kTwo + R"([correlation]
factors = ["pull.force.z", "spring.stiffness"]
matrix = [[1, -0.6], [-0.6, 1]]
)");
  double xy = 0;
  for (std::uint64_t i = 0; i < d.samples(); ++i) {
    const std::vector<double> draws = d.draws(i);
    const Distribution k = lognormal(1000, 200);
    xy += (std::log(draws[0]) - k.mean) / k.sd * (draws[1] - 50) / 5 / static_cast<double>(d.samples());
  }
  EXPECT_NEAR(xy, -0.6, 4 * std::sqrt((1 + 0.36) / static_cast<double>(d.samples())));
}

TEST(SweepDesign, SaltellisBlocksDifferInOneFactor) {
  for (const char* kind : {"monte_carlo", "sobol"}) {
    const SweepDesign d = design(std::string("samples = 8\nindices = true\ndesign = \"") + kind + "\"\n");
    EXPECT_EQ(d.block(), 4u);
    EXPECT_EQ(d.samples(), 32u);
    for (std::uint64_t base = 0; base < 32; base += 4) {
      const auto a = d.draws(base), b = d.draws(base + 1);
      EXPECT_EQ(d.draws(base + 2), (std::vector<double>{b[0], a[1]}));
      EXPECT_EQ(d.draws(base + 3), (std::vector<double>{a[0], b[1]}));
      EXPECT_NE(a[0], b[0]);
    }
  }
}

TEST(SweepDesign, FactorialHasEveryCombinationOnce) {
  const SweepDesign d = design("design = \"factorial\"\nprobabilities = [0.1, 0.5, 0.9]\n", R"([vary]
"spring.stiffness" = { values = [800, 1200] }
"pull.force.z" = { normal = 50, sd = 5 }
)");
  ASSERT_EQ(d.samples(), 6u);
  std::set<std::vector<double>> all;
  for (std::uint64_t i = 0; i < 6; ++i) all.insert(d.draws(i));
  EXPECT_EQ(all.size(), 6u);
  EXPECT_EQ(d.draws(4), (std::vector<double>{1200, 50}));
}

TEST(SweepDesign, AFractionHasTwoLevelsOfEveryFactor) {
  const test::TemporaryFolder folder;
  const std::string three = "\"spring.slack_length\" = { values = [10, 11] }\n";
  const Sweep s = test::ready_sweep(
      test::ball_study(folder, "design = \"fractional_factorial\"\nresolution = 3\n", test::kBallVary + three));
  ASSERT_EQ(s.design.samples(), 4u);  // of 8
  std::set<std::vector<double>> all;
  for (std::uint64_t i = 0; i < 4; ++i) all.insert(s.design.draws(i));
  EXPECT_EQ(all.size(), 4u);
  EXPECT_EQ(s.design.draws(0)[2], 10);
  Diagnostics out;
  const std::string values = "\"spring.stiffness\" = { values = [900, 1000, 1100] }\n";
  EXPECT_FALSE(
      prepare_sweep(test::ball_study(folder, "design = \"fractional_factorial\"\n", "[vary]\n" + values), out));
  EXPECT_TRUE(test::contains(test::messages(out), "study.toml:5:1: vary.spring.stiffness: must have two values"))
      << test::messages(out);
}

TEST(SweepDesign, OneAtATimeStartsFromTheCentre) {
  const SweepDesign d = design("design = \"one_at_a_time\"\n", R"([vary]
"spring.stiffness" = { values = [1000, 800, 1200] }
"pull.force.z" = { normal = 50, sd = 5 }
)");
  ASSERT_EQ(d.samples(), 5u);
  EXPECT_EQ(d.draws(0), (std::vector<double>{1000, 50}));
  EXPECT_EQ(d.draws(2), (std::vector<double>{1200, 50}));
  EXPECT_EQ(d.draws(3)[0], 1000);
  EXPECT_NEAR(d.draws(3)[1], 50 - 5 * 1.6448536, 1e-6);
}

TEST(SweepDesign, ReadsPoints) {
  const test::TemporaryFolder folder;
  folder.write("points.csv", "pull.force.z,spring.stiffness\n50,1000\n60,900\n");
  const std::string vary = "[vary]\n\"spring.stiffness\" = {}\n\"pull.force.z\" = {}\n";
  const std::string head = "design = \"points\"\npoints = \"points.csv\"\n";
  const Sweep s = test::ready_sweep(test::ball_study(folder, head, vary));
  ASSERT_EQ(s.design.samples(), 2u);
  EXPECT_EQ(s.design.draws(1), (std::vector<double>{900, 60}));
  const auto said = [&](const std::string& csv) {
    folder.write("points.csv", csv);
    Diagnostics out;
    EXPECT_FALSE(prepare_sweep(test::ball_study(folder, head, vary), out));
    return test::messages(out);
  };
  EXPECT_TRUE(test::contains(said("pull.force.z,spring.stifness\n50,x\n"), "is no factor of this study; did you mean"));
  EXPECT_TRUE(
      test::contains(said("pull.force.z,spring.stiffness\n50,x\n"), "points.csv:2:4: spring.stiffness = \"x\""));
  EXPECT_TRUE(test::contains(said("pull.force.z,spring.stiffness\n50,-3\n"), "and it must be > 0"));
}

TEST(SweepDesign, RefusesCorrelationsOfNothing) {
  const std::string said = refusals("samples = 4\n", kTwo + R"([correlation]
factors = ["spring.stifness", "pull.force.z", "pull.force.z"]
matrix = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
)");
  EXPECT_TRUE(test::contains(said, ":8:12: correlation.factors = \"spring.stifness\": is no factor")) << said;
  EXPECT_TRUE(test::contains(said, "is given twice")) << said;
  const std::string two = refusals("samples = 4\nindices = true\n", kTwo + R"([correlation]
factors = ["spring.stiffness", "pull.force.z"]
matrix = [[1, 0.5], [0.5, 1]]
)");
  EXPECT_TRUE(test::contains(two, "excludes `indices`")) << two;
}

}  // namespace
}  // namespace genu
