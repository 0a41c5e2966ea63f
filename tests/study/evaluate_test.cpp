// Poses that a run has solved, evaluated again: the same columns. And what is refused.
#include "genu/study/evaluate.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "support/judged.h"
#include "support/scenes.h"
#include "tools/cli_scenes.h"

namespace genu {
namespace {

using test::messages;
using test::read_file;

/// The ball on its plate with a layer between them and a load over time.
std::string soft_ball() {
  return test::with_first(
             test::kBall, "model = \"rigid\"",
             "model = \"cartilage\"\nmodulus = 5\npoisson = 0.4\nthickness = 4\nquadrature = \"triangles\"\n"
             "cast_from = \"ball\"\nregions = { front = \"y > 0\" }") +
         "[load.push]\nbody = \"femur\"\nforce = [0, 1, -30]\nscale = { over = \"time\", table = [[0, 1], [1, 2]] }\n" +
         "[[step]]\nprescribe = { \"knee.flexion\" = [10, 5], \"knee.x\" = 0.1 }\nload = { push = [1, 0.5] "
         "}\nincrements = 3\n";
}

struct Twice {
  Solution solved;
  Evaluation evaluated;
};

Twice run_and_evaluate(const std::string& scene) {
  const test::TemporaryFolder folder;
  Diagnostics out;
  Twice t;
  EXPECT_EQ(test::judged_run(scene, folder / "run", {}, out, &t.solved), kExitOk) << messages(out);
  EXPECT_EQ(evaluate_scene(scene, folder / "run/results.csv", folder / "again", {}, out, &t.evaluated), kExitOk)
      << messages(out);
  EXPECT_EQ(read_file(folder / "again/results.csv"), t.evaluated.poses.to_csv());
  EXPECT_TRUE(std::filesystem::exists(folder / "again/curves.svg"));
  EXPECT_NE(read_file(folder / "again/summary.json").find("\"evaluated\": "), std::string::npos);
  return t;
}

bool ends_with(const std::string& s, const std::string& end) {
  return s.size() >= end.size() && s.compare(s.size() - end.size(), end.size(), end) == 0;
}

/// Every column that a run has and that is not among `empty` has the same number or the same word, or is empty in both.
void expect_same(const Twice& t, const std::function<bool(const std::string&)>& empty,
                 const std::function<double(const std::string&)>& tolerance) {
  const ResultTable &a = t.solved.poses, &b = t.evaluated.poses;
  ASSERT_EQ(a.rows(), b.rows());
  for (const std::string& column : a.columns()) {
    if (column == "branch") continue;  // given poses lie on none
    ASSERT_TRUE(b.has_column(column)) << column;
    for (std::size_t row = 0; row < a.rows(); ++row) {
      const Cell &x = a.at(row, a.column_index(column)), &y = b.at(row, b.column_index(column));
      if (empty(column)) {
        EXPECT_TRUE(std::holds_alternative<std::monostate>(y)) << column;
      } else if (std::holds_alternative<double>(x)) {
        EXPECT_LE(std::abs(a.number(row, column) - b.number(row, column)), tolerance(column))
            << column << " row " << row;
      } else if (column.find(".reaction_") != std::string::npos) {
        // Not prescribed in that step: balanced without, so nothing is needed.
        EXPECT_LE(std::abs(b.number(row, column)), tolerance(column)) << column << " row " << row;
      } else {
        EXPECT_EQ(x, y) << column << " row " << row;
      }
    }
  }
}

bool solvers_own(const std::string& column) {
  return column.rfind("stability", 0) == 0 || column == "newton.iterations" || column == "residual";
}

TEST(Evaluate, AsksForTheFactorOfADrivingLoad) {
  std::string text = soft_ball();
  for (std::size_t at = 0; (at = text.find("[[step]]\n", at)) != std::string::npos; at += 9)
    text.insert(at + 9, "drive = { \"knee.flexion\" = \"turn\" }\n");
  const test::TemporaryFolder folder;
  const std::string drive = folder.write("ball.toml", text + "[load.turn]\non = \"knee.flexion\"\nvalue = 1\n");
  Diagnostics out;
  Solution solved;
  ASSERT_EQ(test::judged_run(drive, folder / "run", {}, out, &solved), kExitOk) << messages(out);
  ASSERT_TRUE(solved.poses.has_column("turn.factor"));
  EXPECT_EQ(evaluate_scene(drive, folder / "run/results.csv", folder / "again", {}, out, nullptr), kExitOk)
      << messages(out);
  // The same table under another name: the factor is missing.
  std::string table = read_file(folder / "run/results.csv");
  table.replace(table.find("turn.factor"), 11, "turn_factor");
  std::ofstream(folder / "poses.csv") << table;
  Diagnostics refused;
  EXPECT_EQ(evaluate_scene(drive, folder / "poses.csv", folder / "no", {}, refused, nullptr), kExitRefused);
  EXPECT_NE(messages(refused).find("the load drives knee.flexion, so its factor is an unknown of every pose"),
            std::string::npos)
      << messages(refused);
}

TEST(Evaluate, PressureMapsOfARunAndOfItsPoses) {
  const test::TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", soft_ball());
  Diagnostics out;
  RunOptions run;
  EvaluateOptions again;
  run.pressure_maps = again.pressure_maps = true;
  Solution solved;
  Evaluation evaluated;
  ASSERT_EQ(test::judged_run(scene, folder / "run", run, out, &solved), kExitOk) << messages(out);
  ASSERT_EQ(evaluate_scene(scene, folder / "run/results.csv", folder / "again", again, out, &evaluated), kExitOk);
  ASSERT_EQ(solved.pressure_files.size(), 1u);
  EXPECT_EQ(solved.pressure_files, evaluated.pressure_files);
  const std::string name = solved.pressure_files[0];
  for (const std::string& text : {read_file(folder / ("run/" + name)), read_file(folder / ("again/" + name))}) {
    double points = 0;
    for (std::size_t row = 0; row < solved.poses.rows(); ++row)
      points += solved.poses.number(row, name.substr(10, name.size() - 14) + ".points");
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + points);
  }
  EXPECT_EQ(test::judged_run(scene, folder / "plain", {}, out, &solved), kExitOk);
  EXPECT_FALSE(std::filesystem::exists(folder / ("plain/" + name)));
}

TEST(Evaluate, GivesARunWithLayersAgainReactionsIncluded) {
  const test::TemporaryFolder folder;
  const Twice t = run_and_evaluate(folder.write("ball.toml", soft_ball()));
  expect_same(t, solvers_own, [](const std::string& c) {
    return c.find(".reaction_") != std::string::npos ? 1e-7 : 1e-9;  // N, N m: what Newton's method leaves
  });
  // The force on knee.x is the whole of what the ball lacks but for the moment that holds its flexion.
  const ResultTable& poses = t.evaluated.poses;
  const std::size_t last = poses.rows() - 1;
  Vec3 force;
  const char* axes[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) force[i] = poses.number(last, std::string("femur.residual_force_") + axes[i] + "_N");
  EXPECT_NEAR(force.norm(), std::abs(poses.number(last, "knee.x.reaction_N")), 1e-7);
  EXPECT_GT(force.norm(), 0.1);
}

TEST(Evaluate, GivesARunWithRigidContactsAgainButForTheirForces) {
  const Twice t = run_and_evaluate(test::dortmans_file());
  expect_same(
      t,
      [](const std::string& c) {
        const bool contact = c.rfind("medial.", 0) == 0 || c.rfind("lateral.", 0) == 0;
        return solvers_own(c) || (contact && ends_with(c, ".force_N")) || c.find(".reaction_") != std::string::npos;
      },
      [](const std::string& c) {
        // A gap that was closed by Newton's method, and where two surfaces are nearest, found in another way.
        const bool contact = c.rfind("medial.", 0) == 0 || c.rfind("lateral.", 0) == 0;
        return contact ? (ends_with(c, ".gap_mm") ? 1e-9 : 1e-5) : 1e-9;
      });
}

TEST(Evaluate, OverlapsAreNegativeGaps) {
  const test::TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", test::kBall);
  const std::string poses = folder.write(
      "poses.csv", "knee.flexion,knee.adduction,knee.rotation,knee.x,knee.y,knee.z\n0,0,0,1,2,25\n0.1,0,0,0,0,17\n");
  EvaluateOptions options;
  options.columns.units = "mm";
  Diagnostics out;
  Evaluation found;
  ASSERT_EQ(evaluate_scene(scene, poses, folder / "out", options, out, &found), kExitOk) << messages(out);
  EXPECT_NEAR(found.poses.number(0, "medial.gap_mm"), 5, 1e-9);
  EXPECT_NEAR(found.poses.number(1, "medial.gap_mm"), -3, 1e-9);
  EXPECT_NEAR(found.poses.number(0, "medial.plate.y_mm"), 2, 1e-6);
  EXPECT_TRUE(std::isnan(found.poses.number(1, "medial.force_N")));
  EXPECT_TRUE(std::isnan(found.poses.number(1, "time_s")));
  EXPECT_EQ(found.poses.number(1, "increment"), 1);
  EXPECT_EQ(test::word(found.poses, 1, "status"), "ok");
  EXPECT_NE(found.summary.verdict.at(1).find("overlap by up to 3 mm"), std::string::npos) << found.summary.verdict[1];
}

TEST(Evaluate, SaysWhereALayerIsDeeperThanItsLawOrItsRays) {
  const test::TemporaryFolder folder;
  const std::string poses = folder.write(
      "poses.csv", "knee.flexion,knee.adduction,knee.rotation,knee.x,knee.y,knee.z\n0,0,0,1,2,19.9\n0,0,0,0,0,16.08\n");
  const auto verdict = [&](const std::string& deep) {
    const std::string scene = test::with_first(
        test::kBall, "model = \"rigid\"",
        "model = \"cartilage\"\nmodulus = 5\npoisson = 0.4\nquadrature = \"smooth\"\nthickness = " + deep);
    EvaluateOptions options;
    options.columns.units = "mm";
    Diagnostics out;
    Evaluation found;
    EXPECT_EQ(evaluate_scene(folder.write("ball.toml", scene), poses, folder / "out", options, out, &found), kExitOk)
        << messages(out);
    std::string all;
    for (const std::string& sentence : found.summary.verdict) all += sentence + "\n";
    return all;
  };
  const std::string beyond_law = verdict("4\nsearch_depth = 10"), beyond_rays = verdict("40\nsearch_depth = 3.93");
  EXPECT_NE(beyond_law.find("compressed by 98 % of its thickness in row 2"), std::string::npos) << beyond_law;
  EXPECT_NE(beyond_rays.find("all of its search depth"), std::string::npos) << beyond_rays;
  EXPECT_EQ(verdict("40").find("compressed"), std::string::npos) << verdict("40");
}

TEST(Evaluate, RoundingIsContactAndNoOverlap) {
  const test::TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", test::kBall);
  const std::string poses = folder.write(
      "poses.csv", "knee.flexion,knee.adduction,knee.rotation,knee.x,knee.y,knee.z\n0,0,0,0,0,19.9999999999\n");
  EvaluateOptions options;
  options.columns.units = "mm";
  Diagnostics out;
  Evaluation found;
  ASSERT_EQ(evaluate_scene(scene, poses, folder / "out", options, out, &found), kExitOk) << messages(out);
  EXPECT_LT(found.poses.number(0, "medial.gap_mm"), 0);
  const std::string& said = found.summary.verdict.at(1);
  EXPECT_NE(said.find("Rigid surfaces are in contact (smallest gap -1e-10 mm, which is rounding)."), std::string::npos)
      << said;
}

TEST(Evaluate, DoesNotReplaceWhatItReads) {
  const test::TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", test::kBall);
  Diagnostics out;
  ASSERT_EQ(test::judged_run(scene, folder / "run", {}, out, nullptr), kExitOk);
  const std::string before = read_file(folder / "run/results.csv");
  EXPECT_EQ(evaluate_scene(scene, folder / "run/results.csv", folder / "run", {}, out, nullptr), kExitRefused);
  EXPECT_NE(messages(out).find("would be lost with the folder"), std::string::npos) << messages(out);
  EXPECT_EQ(read_file(folder / "run/results.csv"), before);
}

TEST(Evaluate, StopsWhereItIsInterruptedAndKeepsTheRest) {
  const test::TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", test::kBall);
  Diagnostics out;
  ASSERT_EQ(test::judged_run(scene, folder / "run", {}, out, nullptr), kExitOk);
  int asked = 0;
  EvaluateOptions options;
  options.cancelled = [&] { return ++asked > 2; };
  Evaluation found;
  EXPECT_EQ(evaluate_scene(scene, folder / "run/results.csv", folder / "out", options, out, &found), kExitIncomplete);
  EXPECT_EQ(found.poses.rows(), 2u);
  EXPECT_NE(found.summary.verdict.at(0).find("Interrupted"), std::string::npos);
}

TEST(Evaluate, SumsASmoothLayerAsFinelyAsARunDoes) {
  const test::TemporaryFolder folder;
  const std::string fine = test::with_first(
      test::with_first(soft_ball(), "quadrature = \"triangles\"", "quadrature = \"smooth\"\ntolerance = 1e-6"),
      "cast_from = \"ball\"\n", "");
  const Twice t = run_and_evaluate(folder.write("ball.toml", fine));
  for (std::size_t row = 0; row < t.solved.poses.rows(); ++row) {
    const double force = t.solved.poses.number(row, "medial.force_z_N");
    EXPECT_NEAR(t.evaluated.poses.number(row, "medial.force_z_N"), force, 2e-6 * std::abs(force)) << row;
    EXPECT_GT(std::abs(force), 10);
  }
  EXPECT_GT(t.solved.records.back().point.pose.state.layer_level(0), 0) << "nothing was asked of the tolerance";
}

}  // namespace
}  // namespace genu
