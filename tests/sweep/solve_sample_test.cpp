#include "genu/sweep/solve_sample.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/mesh_care/noise_field.h"
#include "genu/study/run_motion.h"
#include "genu/sweep/statistics.h"
#include "support/meshed_ball.h"
#include "support/text.h"
#include "sweep/ball.h"

namespace genu {
namespace {

TEST(SolveSample, FollowsTheClosedForm) {
  const test::TemporaryFolder folder;
  const Sweep s = test::ready_sweep(test::ball_study(folder, "samples = 50\n", test::kBallVary));
  for (std::uint64_t i = 0; i < s.design.samples(); ++i) {
    const auto r = solve_sample(s, s.cases[0], i, {});
    ASSERT_TRUE(r);
    EXPECT_EQ(r->verdict, "solved") << r->reason;
    EXPECT_EQ(r->draws, s.design.draws(i));
    const double z = 10 * (1 + r->draws[1] / (1000 * r->draws[0]));
    for (const double kept : r->kept) EXPECT_NEAR(kept, z, 1e-10);
  }
}

TEST(SolveSample, MeanAndVarianceAreThoseOfTheClosedForm) {
  // 1 / K of a lognormal K is lognormal; F is uniform and independent of it.
  const test::TemporaryFolder folder;
  const Sweep s = test::ready_sweep(test::ball_study(folder, "samples = 4000\n", test::kBallVary));
  std::vector<double> z;
  for (std::uint64_t i = 0; i < s.design.samples(); ++i) z.push_back(solve_sample(s, s.cases[0], i, {})->kept[0]);
  const Distribution k = lognormal(1000, 200);
  const double k1 = std::exp(-k.mean + k.sd * k.sd / 2), k2 = std::exp(-2 * k.mean + 2 * k.sd * k.sd);
  const double f1 = 50, f2 = f1 * f1 + 20.0 * 20 / 12;
  const double mean = 10 * (1 + f1 * k1), variance = 100 * (f2 * k2 - f1 * f1 * k1 * k1);
  const Moments m = moments(z);
  const double n = static_cast<double>(z.size());
  double fourth = 0;
  for (const double v : z) fourth += std::pow(v - m.mean, 4) / n;
  EXPECT_NEAR(m.mean, mean, 4 * std::sqrt(variance / n));
  EXPECT_NEAR(m.sd * m.sd, variance, 4 * std::sqrt((fourth - variance * variance) / n));
}

TEST(SolveSample, OfAMeshThatErrsHasTheHeightOfItsField) {
  const test::TemporaryFolder folder;
  const Sweep s = test::ready_sweep(test::meshed_ball_study(folder, "samples = 48\n"));
  const auto as_it_is =
      test::ready_sweep(test::meshed_ball_study(folder, "samples = 1\n", "{ sd = 1e-9, correlation_length = 15 }"));
  const double z0 = solve_sample(as_it_is, as_it_is.cases[0], 0, {})->kept[0];
  EXPECT_NEAR(z0, 20, 2e-3);  // what the fit makes of triangles of 2 mm
  std::vector<double> z;
  double off = 0;
  for (std::uint64_t i = 0; i < s.design.samples(); ++i) {
    const auto r = solve_sample(s, s.cases[0], i, {});
    ASSERT_TRUE(r);
    EXPECT_EQ(r->verdict, "solved") << r->reason;
    z.push_back(r->kept[0]);
    const Vec3 bottom(0, 0, -test::kBallRadius);
    off = std::max(off,
                   std::abs(z.back() - z0 -
                            1e3 * noise_field({bottom}, {20e-6, 15e-3}, static_cast<std::uint64_t>(r->draws[0]))[0]));
  }
  EXPECT_LT(off, 2e-3);  // mm, of 0.02: the lowest point is beside the bottom, and the fit smooths
  // Its spread is that of the error itself: four standard errors of a standard deviation are 41 %.
  EXPECT_NEAR(moments(z).sd, 0.02, 4 * 0.02 / std::sqrt(2 * 48.0));
  EXPECT_NEAR(moments(z).mean, z0, 4 * 0.02 / std::sqrt(48.0));
}

TEST(SolveSample, OfAMeshThatErrsDependsOnSeedAndNumberAlone) {
  const test::TemporaryFolder folder;
  const auto draws = [&](const std::string& head) {
    return test::ready_sweep(test::meshed_ball_study(folder, head)).design.draws(4)[0];
  };
  const double draw = draws("samples = 5\n");
  EXPECT_EQ(draw, std::floor(draw));
  EXPECT_EQ(draws("samples = 5000\n"), draw);
  EXPECT_EQ(draws("samples = 64\ndesign = \"sobol\"\n"), draw);
  EXPECT_EQ(draws("samples = 64\ndesign = \"latin_hypercube\"\n"), draw);
  EXPECT_NE(draws("samples = 5\nseed = 2\n"), draw);
  // Sobol indices: A, B and AB of a block; with one factor AB is B.
  const Sweep blocks = test::ready_sweep(test::meshed_ball_study(folder, "samples = 5\nindices = true\n"));
  EXPECT_NE(blocks.design.draws(3)[0], blocks.design.draws(4)[0]);
  EXPECT_EQ(blocks.design.draws(5)[0], blocks.design.draws(4)[0]);
}

TEST(SolveSample, EqualsANormalRunOfItsScene) {
  const test::TemporaryFolder folder;
  const std::string study = folder.write("study.toml", "format = 1\nscene = \"" + test::dortmans_file() + R"("
samples = 6
[vary]
"*C.stiffness" = { lognormal = 1, sd = 0.2, relative = true }
"*C.reference_strain" = { normal = 0, sd = 0.005, add = true }
"LC.from.x" = { normal = 40, sd = 0.3 }
"femur_*.minor_radius:together" = { uniform = [4.9, 5.1] }
[[keep]]
columns = ["knee.adduction", "knee.flexion.reaction", "*.force"]
at = [0, 33, 70]
)");
  const Sweep all = test::ready_sweep(study);
  EXPECT_TRUE(all.cases[0].factors.prepares_anew());
  std::string text = test::read_file(study);
  folder.write("light.toml",
               test::with_first(text, "\"femur_*.minor_radius:together\" = { uniform = [4.9, 5.1] }\n", ""));
  const Sweep light = test::ready_sweep(folder / "light.toml");
  EXPECT_FALSE(light.cases[0].factors.prepares_anew());
  for (const Sweep* s : {&all, &light})
    for (std::uint64_t i = 0; i < 6; ++i) {
      const auto sample = solve_sample(*s, s->cases[0], i, {});
      ASSERT_TRUE(sample);
      EXPECT_EQ(sample->verdict, "solved") << sample->reason;
      Diagnostics out;
      const auto prepared = prepare(source_of_sample(*s, s->cases[0], i), out);
      ASSERT_TRUE(prepared) << test::messages(out);
      ContactField field(prepared->model);
      const Solution solution = solve(*prepared, field, {});
      EXPECT_EQ(sample->kept, kept_values(s->kept, s->cases[0].main, solution.poses, true));  // the same bits
    }
}

TEST(SolveSample, TellsWhyASampleHasNoAnswer) {
  // Pulled by 5000 N the spring is six times as long: implausible. Without a force nothing holds the ball.
  const test::TemporaryFolder folder;
  folder.write("points.csv", "pull.force.z\n50\n5000\n0\n");
  const Sweep s = test::ready_sweep(
      test::ball_study(folder, "design = \"points\"\npoints = \"points.csv\"\n", "[vary]\n\"pull.force.z\" = {}\n"));
  EXPECT_EQ(solve_sample(s, s.cases[0], 0, {})->verdict, "solved");
  const auto doubtful = solve_sample(s, s.cases[0], 1, {});
  EXPECT_EQ(doubtful->verdict, "doubtful");
  EXPECT_TRUE(test::contains(doubtful->reason, "strain of spring")) << doubtful->reason;
  EXPECT_NEAR(doubtful->kept[0], 60, 1e-9);
  const auto failed = solve_sample(s, s.cases[0], 2, {});
  EXPECT_EQ(failed->verdict, "not_solved");
  EXPECT_TRUE(test::contains(failed->reason, "the equilibrium is not unique at j.rz_deg = 0")) << failed->reason;
  EXPECT_TRUE(std::isnan(failed->kept[0]));
}

TEST(SolveSample, ThatStopsOnItsWayHasNoExtremes) {
  // A table of the pull over the rotation that ends in no pull: from there on nothing holds the ball along the spring.
  const test::TemporaryFolder folder;
  const std::string study =
      test::ball_study(folder, "samples = 1\n", "[vary]\n\"spring.stiffness\" = { values = [1000] }\n");
  folder.write("ball.toml", test::with_first(test::kBallOnSpring, "force = [0, 0, 50]",
                                             "force = [0, 0, 50]\nscale = { over = \"j.rz\", table = [[0, 1], [5, 1], "
                                             "[6, 0]] }"));
  folder.write("study.toml", test::with_first(test::read_file(study), "\"last\"]", "2.5, \"last\", \"max\", \"min\"]"));
  const Sweep s = test::ready_sweep(study);
  const auto r = solve_sample(s, s.cases[0], 0, {});
  ASSERT_TRUE(r);
  EXPECT_EQ(r->verdict, "not_solved");
  EXPECT_NEAR(r->kept[0], 10.5, 1e-9);
  EXPECT_NEAR(r->kept[2], 10.5, 1e-9);
  for (const std::size_t k : {1u, 3u, 4u, 5u}) EXPECT_TRUE(std::isnan(r->kept[k])) << s.kept[k].name;
}

/// A study of the ball in motion.
std::string motion_study(const test::TemporaryFolder& folder, const std::string& scene, const std::string& points) {
  folder.write("ball.toml", scene);
  folder.write("points.csv", points);
  return folder.write("study.toml", R"(format = 1
scene = "ball.toml"
design = "points"
points = "points.csv"
[vary]
"spring.stiffness" = {}
"pull.force.z" = {}
[[keep]]
columns = ["j.z"]
at = ["all", "last", "max"]
)");
}

TEST(SolveSample, FollowsAMotion) {
  const test::TemporaryFolder folder;
  const Sweep s =
      test::ready_sweep(motion_study(folder, test::kBallInMotion, "spring.stiffness,pull.force.z\n1000,50\n1200,60\n"));
  EXPECT_EQ(s.cases[0].main.column, "time_s");
  ASSERT_EQ(s.kept.size(), 5u);
  for (std::uint64_t i = 0; i < 2; ++i) {
    const auto r = solve_sample(s, s.cases[0], i, {});
    ASSERT_TRUE(r);
    EXPECT_EQ(r->verdict, "solved") << r->reason;
    EXPECT_EQ(r->reason, "");
    const double rest = 10 * (1 + r->draws[1] / r->draws[0]), frequency = std::sqrt(r->draws[0] / 0.01);
    const auto z = [&](double t) { return rest + (11 - rest) * std::cos(frequency * t); };
    const double expected[] = {11, z(0.003), z(0.004), z(0.004), 11};
    for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(r->kept[k], expected[k], 1e-6) << s.kept[k].name;
    Diagnostics out;
    const auto prepared = prepare(source_of_sample(s, s.cases[0], i), out);
    ASSERT_TRUE(prepared) << test::messages(out);
    EXPECT_EQ(r->kept, kept_values(s.kept, s.cases[0].main, solve_motion(*prepared, {}).poses, true));  // the same bits
  }
  EXPECT_FALSE(solve_sample(s, s.cases[0], 0, [] { return true; }));
}

TEST(SolveSample, OfAMotionWithoutBalanceSaysSo) {
  // Prescribed to move 10 mm in 10 ns: the tolerance sees nothing of the work that this takes.
  const test::TemporaryFolder folder;
  const std::string jump = "duration = 1\nprescribe = { \"j.x\" = { table = [[0.5, 0], [0.50000001, 10]] } }\n";
  std::string scene = test::with_first(test::kBallInMotion, "duration = 0.004\n", jump);
  scene = test::with_first(scene, "tolerance = 1e-10", "tolerance = 1e-6");
  scene = test::with_first(scene, "output_interval = 0.003", "output_interval = 0.25");
  const Sweep s = test::ready_sweep(motion_study(folder, scene, "spring.stiffness,pull.force.z\n1000,60\n"));
  const auto r = solve_sample(s, s.cases[0], 0, {});
  ASSERT_TRUE(r);
  EXPECT_EQ(r->verdict, "not_solved");
  EXPECT_TRUE(r->reason.starts_with("Its energies do not balance")) << r->reason;
  EXPECT_TRUE(std::isfinite(r->kept[0]));
  for (std::size_t k = 5; k < 7; ++k) EXPECT_TRUE(std::isnan(r->kept[k])) << s.kept[k].name;
}

TEST(PrepareSweep, TakesAMotionThatBeginsAtEquilibrium) {
  // Its given start may overlap by more than the 6 mm from which a search of steps begins.
  const test::TemporaryFolder folder;
  folder.write("ball.toml", R"(format = 1
units = { length = "mm", angle = "deg" }
gravity = [0, 0, -9.81]
[body.ground]
fixed = true
[body.ball]
mass = 1
inertia = [0.001, 0.001, 0.001]
[joint.j]
type = "free"
parent = "ground"
child = "ball"
rotations = ["rx x", "ry y", "rz z"]
translations = ["x", "y", "z"]
reference = { z = 22 }
[surface.skin]
body = "ball"
shape = "sphere"
radius = 30
[surface.plate]
body = "ground"
shape = "plane"
[contact.c]
surfaces = ["skin", "plate"]
model = "rigid"
[dynamics]
start = "equilibrium"
duration = 0.004
output_interval = 0.003
)");
  const Sweep s = test::ready_sweep(folder.write("study.toml", R"(format = 1
scene = "ball.toml"
samples = 1
[vary]
"ball.mass" = { uniform = [1, 2] }
[[keep]]
columns = ["j.z", "c.force"]
at = "last"
)"));
  const auto r = solve_sample(s, s.cases[0], 0, {});
  ASSERT_TRUE(r);
  EXPECT_EQ(r->verdict, "solved") << r->reason;
  EXPECT_NEAR(r->kept[0], 30, 1e-9);
  EXPECT_NEAR(r->kept[1], 9.81 * r->draws[0], 1e-6);
}

TEST(SolveSample, CanBeCalledOff) {
  const test::TemporaryFolder folder;
  const Sweep s = test::ready_sweep(test::ball_study(folder, "samples = 4\n", test::kBallVary));
  EXPECT_FALSE(solve_sample(s, s.cases[0], 0, [] { return true; }));
}

}  // namespace
}  // namespace genu
