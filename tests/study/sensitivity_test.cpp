#include "genu/study/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include <gtest/gtest.h>

#include "support/finite_difference.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "tools/cli_scenes.h"

namespace genu {
namespace {

/// Where a ligament is about to become taut differences straddle the bend of its law's slope.
bool near_a_bend(const ResultTable& poses, std::size_t row) {
  constexpr double kNear = 2e-3;
  return std::any_of(poses.columns().begin(), poses.columns().end(), [&](const std::string& column) {
    return column.find(".strain") != std::string::npos && std::abs(poses.number(row, column)) < kNear;
  });
}

TEST(RunSensitivity, ACancelledRunKeepsItsRowsAndTheEarlierResult) {
  test::TemporaryFolder folder;
  Diagnostics out;
  RunOptions options;
  const SensitivityChoice choice{{"knee.adduction"}, {"LC.stiffness"}};
  SensitivityResult whole, part;
  ASSERT_EQ(run_sensitivity(test::dortmans_file(), folder / "a", choice, options, out, whole), kExitOk);
  int rows = 0;
  options.progress = [&](int done, int) { rows = done; };
  options.cancelled = [&] { return rows >= 10; };
  EXPECT_EQ(run_sensitivity(test::dortmans_file(), folder / "a", choice, options, out, part), kExitIncomplete);
  EXPECT_EQ(part.solution.folder, folder / "a.interrupted");
  const auto size = [&](const char* file) { return std::filesystem::file_size(folder / file); };
  EXPECT_GT(size("a.interrupted/sensitivity.csv"), 0u);
  EXPECT_GT(size("a/sensitivity.csv"), size("a.interrupted/sensitivity.csv"));
}

TEST(RunSensitivity, WholePathsOfTheEditedSceneAgree) {
  // Nothing in common with the derivatives but the scene: every pose of two edited scenes, found from the start.
  SensitivityResult r;
  Diagnostics out;
  const SensitivityChoice choice{{"knee.adduction", "knee.x", "medial.force", "LC.force", "knee.flexion.reaction"},
                                 {"LC.stiffness", "AAC.reference_strain", "femur_medial.minor_radius", "PMC.to.y"}};
  ASSERT_EQ(run_sensitivity(test::dortmans_file(), {}, choice, {}, out, r), kExitOk) << test::messages(out);
  EXPECT_EQ(r.poses_without, 0);
  ASSERT_EQ(r.rows.outputs.size(), 5u);
  ASSERT_EQ(r.rows.parameters.size(), 4u);
  Diagnostics ignored;
  const auto scene = read_scene(test::dortmans_file(), ignored);
  ASSERT_TRUE(scene);
  double worst = 0;
  int compared = 0;
  for (std::size_t k = 0; k < r.rows.parameters.size(); ++k) {
    const Parameter& p = r.rows.parameters[k];
    const auto solved_with = [&](double share) {
      Scene edited = *scene;
      const auto o = static_cast<std::size_t>(p.object);
      if (p.kind == Parameter::Kind::law_number) edited.ligaments[o].numbers[0].value += share * p.change;
      if (p.kind == Parameter::Kind::reference_strain) edited.ligaments[o].rest_value += share * p.change;
      if (p.kind == Parameter::Kind::surface_number) *parameter_number(edited, p) += share * p.change;
      if (p.kind == Parameter::Kind::to_point) edited.ligaments[o].to.point[p.component] += share * p.change;
      const ResultTable poses = test::solved(edited).poses;
      MatX numbers(static_cast<Eigen::Index>(poses.rows()), 5);
      for (Eigen::Index row = 0; row < numbers.rows(); ++row)
        for (Eigen::Index o2 = 0; o2 < 5; ++o2)
          numbers(row, o2) =
              poses.number(static_cast<std::size_t>(row), r.rows.outputs[static_cast<std::size_t>(o2)].column);
      return numbers;
    };
    const MatX truth = test::derivative(solved_with, 0.01);
    for (Eigen::Index o = 0; o < 5; ++o) {
      for (Eigen::Index row = 0; row < truth.rows(); ++row) {
        if (near_a_bend(r.solution.poses, static_cast<std::size_t>(row))) continue;
        ++compared;
        const double exact = r.rows.effect(static_cast<std::size_t>(row), static_cast<std::size_t>(o), k);
        const double error = std::abs(exact - truth(row, o)) / truth.col(o).cwiseAbs().maxCoeff();
        worst = std::max(worst, error);
      }
    }
  }
  std::printf("%d derivatives along the path: worst error %.2g of the largest\n", compared, worst);
  EXPECT_LT(worst, 1e-6);
  EXPECT_GT(compared, 20 * 50);
}

TEST(RunSensitivity, RefusesAllUnknownNamesAtOnceWithSuggestions) {
  SensitivityResult r;
  Diagnostics out;
  const SensitivityChoice choice{{"knee.aduction", "stability", "*.points", "medial.force", "*.min_eigenvalue"},
                                 {"AAC.stifness", "LC.slack_length", "nothing.*", "LC.stiffness"}};
  EXPECT_EQ(run_sensitivity(test::dortmans_file(), {}, choice, {}, out, r), kExitRefused);
  const std::string said = test::messages(out);
  EXPECT_EQ(out.items().size(), 7u) << said;
  for (const char* piece :
       {"did you mean \"knee.adduction\"?", "did you mean \"AAC.stiffness\"?", "\"stability\": matches stability",
        "third derivatives", "\"nothing.*\": is no parameter", "\"LC.slack_length\": is no parameter"})
    EXPECT_NE(said.find(piece), std::string::npos) << piece << "\n" << said;
  EXPECT_TRUE(r.solution.records.empty());
}

TEST(RunSensitivity, SaysWhatTheObjectsThatAreNamedHave) {
  SensitivityResult r;
  Diagnostics out;
  EXPECT_EQ(run_sensitivity(test::dortmans_file(), {}, {{"knee.x"}, {"*.slack_length", "femur_*.height"}}, {}, out, r),
            kExitRefused);
  const std::string said = test::messages(out);
  EXPECT_NE(said.find("its ligaments have stiffness, reference_strain, from.x"), std::string::npos) << said;
  EXPECT_NE(said.find("its surfaces have major_radius, minor_radius, origin.x"), std::string::npos) << said;
}

TEST(RunSensitivity, ParametersMovedTogetherAddTheirEffects) {
  SensitivityResult r;
  Diagnostics out;
  const std::string bundle = "*AC.reference_strain+LC.stiffness:together";
  const SensitivityChoice choice{{"knee.rotation", "medial.force"}, {"?AC.reference_strain", "LC.stiffness", bundle}};
  ASSERT_EQ(run_sensitivity(test::dortmans_file(), {}, choice, {}, out, r), kExitOk) << test::messages(out);
  ASSERT_EQ(r.rows.parameters.size(), 4u);  // AAC, PAC, LC and the bundle of them
  EXPECT_EQ(r.rows.parameters[3].name, bundle);
  double worst = 0, largest = 0;
  for (std::size_t row = 0; row < r.rows.rows(); ++row) {
    for (std::size_t o = 0; o < 2; ++o) {
      double sum = 0;
      for (std::size_t p = 0; p < 3; ++p) sum += r.rows.effect(row, o, p);
      worst = std::max(worst, std::abs(r.rows.effect(row, o, 3) - sum));
      largest = std::max(largest, std::abs(sum));
    }
  }
  EXPECT_GT(largest, 0.1);
  EXPECT_LT(worst, 1e-12 * largest);
  EXPECT_NE(r.text.find(bundle), std::string::npos) << r.text;
  EXPECT_EQ(run_sensitivity(test::dortmans_file(), {}, {{"knee.x"}, {":together", "none.*:together"}}, {}, out, r),
            kExitRefused);
  EXPECT_NE(test::messages(out).find("nothing to move together"), std::string::npos);
}

TEST(RunSensitivity, WhereLoadsDriveTheirFactorsSayWhere) {
  const test::TemporaryFolder folder;
  std::string text = test::read_file(test::dortmans_file());
  text = text.substr(0, text.find("[[step]]"));
  text += "[load.M]\non = \"knee.flexion\"\n[[step]]\nload = { M = [-0.5, 0] }\nincrements = 2\n";
  Diagnostics out;
  SensitivityResult r;
  const SensitivityChoice choice{{"knee.flexion"}, {"LC.stiffness"}};
  EXPECT_EQ(run_sensitivity(folder.write("scene.toml", text), folder / "out", choice, {}, out, r), kExitOk);
  EXPECT_NE(r.text.find("at M.factor = "), std::string::npos) << test::messages(out) << r.text;
  const std::string csv = test::read_file(folder / "out/sensitivity.csv");
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "step,increment,M.factor,output,parameter,derivative,unit,change,effect");
}

TEST(RunSensitivity, RefusesMoreThanCanBeKept) {
  Diagnostics out;
  SensitivityResult r;
  std::string text = test::read_file(test::dortmans_file());
  const std::string increments = "increments = 70";
  ASSERT_NE(text.find(increments), std::string::npos);
  text.replace(text.find(increments), increments.size(), "increments = 7000");
  const test::TemporaryFolder folder;
  EXPECT_EQ(run_sensitivity(folder.write("scene.toml", text), {}, {{"all"}, {"all"}}, {}, out, r), kExitRefused);
  EXPECT_NE(test::messages(out).find("ask for fewer"), std::string::npos) << test::messages(out);
}

TEST(RunSensitivity, WritesTheRunAndItsDerivatives) {
  const test::TemporaryFolder folder;
  Diagnostics out;
  SensitivityResult r;
  for (int again = 0; again < 2; ++again)
    ASSERT_EQ(run_sensitivity(test::dortmans_file(), folder / "out",
                              {{"knee.rotation", "medial.7.gap"}, {"*.stiffness"}}, {}, out, r),
              kExitOk)
        << test::messages(out);
  for (const char* file : {"results.csv", "summary.json", "sensitivity.csv", "ranking.csv", "sensitivity.svg"})
    EXPECT_TRUE(std::filesystem::exists(folder / (std::string("out/") + file))) << file;
  const std::string csv = test::read_file(folder / "out/sensitivity.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 71 * 7);
  EXPECT_NE(r.text.find("medial.7.gap: no contact of that number was made"), std::string::npos) << r.text;
  EXPECT_NE(r.text.find("knee.rotation_deg: what one standard change"), std::string::npos) << r.text;
}

TEST(RunSensitivity, PosesThatAreNotDeterminedHaveEmptyCellsAndACount) {
  const test::TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", R"(format = 1
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
[body.ball]
[joint.j]
type = "free"
parent = "ground"
child = "ball"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
reference = { z = -20 }
[ligament.rope]
from = { body = "ball", point = [0, 0, 0] }
to = { body = "ground", point = [0, 0, 0] }
law = "spring"
stiffness = 2
slack_length = 20
[load.pull]
body = "ball"
force = [0, 0, -5]
[[step]]
increments = 1
)");
  Diagnostics out;
  SensitivityResult r;
  EXPECT_EQ(run_sensitivity(scene, {}, {{"rope.length"}, {"rope.stiffness"}}, {}, out, r), kExitIncomplete);
  ASSERT_FALSE(r.rows.derivatives.empty()) << test::messages(out);
  EXPECT_EQ(r.poses_without, static_cast<int>(r.solution.records.size()));
  for (const double d : r.rows.derivatives) EXPECT_TRUE(std::isnan(d));
  EXPECT_NE(r.text.find("have no derivative"), std::string::npos) << r.text;
}

TEST(RunSensitivity, RefusesWhatAnElasticLayerHasNoDerivativeOf) {
  const test::TemporaryFolder folder;
  const auto soft = [&](const std::string& quadrature) {
    const std::string layer = "model = \"cartilage\"\nmodulus = 5\npoisson = 0.4\nthickness = 4\nquadrature = ";
    return folder.write("ball.toml", test::with_first(test::kBall, "model = \"rigid\"", layer + quadrature) +
                                         "[[step]]\nprescribe = { \"knee.flexion\" = [10, 5] }\nincrements = 3\n");
  };
  std::string scene = soft("\"triangles\"\ncast_from = \"ball\"");
  const auto refused = [&](const SensitivityChoice& choice) {
    Diagnostics out;
    SensitivityResult r;
    EXPECT_EQ(run_sensitivity(scene, {}, choice, {}, out, r), kExitRefused);
    return test::messages(out);
  };
  for (const char* pattern : {"ball.radius", "ball.*", "plate.offset", "ball.radius+plate.offset:together"}) {
    const std::string why = refused({{"knee.z"}, {pattern}});
    EXPECT_NE(why.find("the elastic layer medial presses"), std::string::npos) << pattern << "\n" << why;
  }
  for (const char* pattern : {"medial.force_z", "medial.*", "medial.area_mm2"}) {
    const std::string why = refused({{pattern}, {"front.stiffness"}});
    EXPECT_NE(why.find("a number of an elastic layer"), std::string::npos) << pattern << "\n" << why;
  }
  // What has derivatives has them: against runs of the edited scene.
  scene = soft("\"smooth\"");
  Diagnostics out;
  SensitivityResult r;
  ASSERT_EQ(run_sensitivity(scene, {}, {{"knee.z"}, {"all"}}, {}, out, r), kExitOk) << test::messages(out);
  EXPECT_NE(r.text.find("not of the surfaces under elastic layers (medial)"), std::string::npos) << r.text;
  const auto stiffer = [&](double k) {
    return test::table_of(test::with_first(test::read_file(scene), "stiffness = 20000\nreference_strain = 0.05",
                                           "stiffness = " + std::to_string(k) + "\nreference_strain = 0.05"));
  };
  constexpr double kStep = 20;
  const ResultTable above = stiffer(20000 + kStep), below = stiffer(20000 - kStep);
  const auto& known = r.rows.parameters;
  const auto p = static_cast<std::size_t>(
      std::find_if(known.begin(), known.end(), [](const Parameter& x) { return x.name == "front.stiffness"; }) -
      known.begin());
  ASSERT_LT(p, known.size());
  for (std::size_t row = 0; row < above.rows(); ++row) {
    const double difference = (above.number(row, "knee.z_mm") - below.number(row, "knee.z_mm")) / (2 * kStep);
    EXPECT_NEAR(r.rows.derivatives[row * known.size() + p], difference, 1e-5 * std::abs(difference)) << row;
  }
}

}  // namespace
}  // namespace genu
