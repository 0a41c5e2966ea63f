// Errors beside closed forms and times, the extrapolation on made sequences, and a chosen setting that does what it
// said.
#include "genu/study/accuracy.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <regex>
#include <sstream>

#include <gtest/gtest.h>

#include "genu/study/chosen_scene.h"
#include "support/judged.h"
#include "support/places.h"
#include "support/scenes.h"

namespace genu {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Extrapolate, FindsErrorAndOrderOfAPowerLaw) {
  for (const double order : {1.0, 2.0, 3.7}) {
    const auto d = [&](double f) { return 0.3 * (std::pow(f, order) - 1); };
    AccuracyGroup group;
    extrapolate({1.5, 2, 3}, {d(1.5), d(2), d(3)}, group);
    EXPECT_NEAR(group.order, order, 1e-9);
    EXPECT_NEAR(group.finest_error, 0.3, 1e-9);
    EXPECT_LT(group.finest_uncertainty, 1e-9);
  }
}

TEST(Extrapolate, SaysThatNoiseHasNoOrder) {
  AccuracyGroup group;
  extrapolate({1.5, 2, 3}, {0.2, 0.19, 0.21}, group);
  EXPECT_EQ(group.order, 0);
  EXPECT_EQ(group.finest_error, 0.2);
  EXPECT_EQ(group.finest_uncertainty, 0.2);
  // Two meshes alone: an order, and nothing to tell how far it can be trusted.
  extrapolate({2, 4}, {0.3, 1.5}, group);
  EXPECT_NEAR(group.order, 2, 1e-9);
  EXPECT_NEAR(group.finest_error, 0.1, 1e-9);
  EXPECT_EQ(group.finest_uncertainty, group.finest_error);
  extrapolate({}, {}, group);
  EXPECT_EQ(group.finest_error, 0);
  extrapolate({1.5}, {kNaN}, group);
  EXPECT_EQ(group.finest_error, 0);
}

TEST(LargestDifference, ComparesRowsThatMeanTheSame) {
  const auto table = [](const std::vector<double>& values) {
    ResultTable t;
    t.add_column("a");
    for (const double v : values) t.add_row(), t.set("a", v);
    return t;
  };
  const ResultTable coarse = table({0, 1, 2}), fine = table({0, 7, 1.5, 7, 2.25}), gap = table({0, kNaN, 2.1});
  EXPECT_DOUBLE_EQ(largest_difference(coarse, fine, {"a"}, 2), 0.5);
  EXPECT_DOUBLE_EQ(largest_difference(fine, coarse, {"a"}, 0.5), 0.5);
  EXPECT_NEAR(largest_difference(coarse, gap, {"a"}, 1), 0.1, 1e-12);
  EXPECT_TRUE(std::isnan(largest_difference(coarse, fine, {"b"}, 1)));
}

class Accuracy : public testing::Test {
 protected:
  int run(const std::string& scene, const std::vector<std::string>& targets) {
    out_ = {};
    report_ = {};
    return run_accuracy(scene, folder_ / "out", {targets, 1, 60}, {}, out_, report_, own_);
  }
  std::string knee() {
    return folder_.write("scene.toml", std::regex_replace(test::read_file(genu::test::source_folder() +
                                                                          "/meshes/dortmans1984/scene.toml"),
                                                          std::regex("increments = 70"), "increments = 8"));
  }
  const AccuracyPoint* point(const std::string& name) const {
    for (const AccuracyPoint& p : report_.points)
      if (p.name == name) return &p;
    return nullptr;
  }
  double worst(const AccuracyPoint& p, const std::string& group) const {
    for (std::size_t g = 0; g < report_.groups.size(); ++g)
      if (report_.groups[g].name == group) return p.errors[g];
    return kNaN;
  }

  test::TemporaryFolder folder_;
  Diagnostics out_;
  AccuracyReport report_;
  Solution own_;
};

TEST_F(Accuracy, OfAKneeInClosedFormFallsWithTheEdges) {
  ASSERT_EQ(run(knee(), {}), kExitOk) << test::messages(out_);
  ASSERT_EQ(report_.groups.size(), 4u);
  EXPECT_EQ(worst(report_.points[0], "position"), 0);
  const AccuracyPoint *coarse = point("edge 2.01 mm, degree 3"), *middle = point("edge 1.00 mm, degree 3"),
                      *fine = point("edge 0.50 mm, degree 3");
  ASSERT_TRUE(coarse && middle && fine);
  for (const AccuracyPoint* p : {coarse, middle, fine}) EXPECT_TRUE(p->complete());
  // Fits of degree 3: order 4, roughly.
  EXPECT_GT(worst(*coarse, "position"), 6 * worst(*middle, "position"));
  EXPECT_GT(worst(*middle, "position"), 6 * worst(*fine, "position"));
  // The solver's own error, and paths in other increments, which are the same path.
  ASSERT_NE(point("tolerance 1e-10"), nullptr);
  EXPECT_LT(worst(*point("tolerance 1e-10"), "position"), 1e-9);
  EXPECT_LT(worst(*point("increments x 2"), "position"), 1e-9);
  EXPECT_NE(report_.sentence.find(" a pose: "), std::string::npos) << report_.sentence;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/accuracy.svg"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/accuracy.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/scene.toml")) << "no target was asked for";
  EXPECT_NE(to_text(report_).find("<- chosen"), std::string::npos);
}

TEST_F(Accuracy, TheChosenSceneIsAsExactAsWasSaid) {
  const std::string scene = knee();
  ASSERT_EQ(run(scene, {"0.005mm", "0.01 deg"}), kExitOk) << test::messages(out_);
  ASSERT_GE(report_.chosen, 0);
  const AccuracyPoint& chosen = report_.points[static_cast<std::size_t>(report_.chosen)];
  EXPECT_GT(chosen.setting.edge_factor, 0);
  EXPECT_LE(worst(chosen, "position"), 0.005);
  EXPECT_LE(worst(chosen, "rotation"), 0.01);
  const ResultTable exact = own_.poses;
  Solution written;
  Diagnostics out;
  ASSERT_EQ(test::judged_run(folder_ / "out/scene.toml", folder_ / "again", {}, out, &written), kExitOk)
      << test::messages(out);
  for (const AccuracyGroup& group : report_.groups)
    EXPECT_NEAR(largest_difference(exact, written.poses, group.columns, 1), worst(chosen, group.name),
                1e-3 * worst(chosen, group.name))
        << group.name;
}

/// Once all settings are solved the time that was asked for counts, and one round is enough to choose.
TEST_F(Accuracy, OneRoundHasTheTolerancesOfTheChosenMeshToo) {
  ASSERT_EQ(run_accuracy(knee(), std::nullopt, {{"0.005mm"}, 9, 0}, {}, out_, report_, own_), kExitOk);
  EXPECT_EQ(report_.rounds, 1);
  EXPECT_NE(to_text(report_).find("nothing tells how far to trust it"), std::string::npos);
  const auto joined = [](const AccuracyPoint& p) { return p.setting.tolerance > 0 && p.setting.edge_factor > 0; };
  EXPECT_EQ(std::count_if(report_.points.begin(), report_.points.end(), joined), 1);
}

/// The tolerance that was solved with is the one that is written, wherever the file says its own.
TEST_F(Accuracy, AChosenToleranceIsWrittenAndAsExactAsWasSaid) {
  const std::string text = test::read_file(knee());
  const std::size_t units = text.find("units = ");
  const std::vector<std::string> scenes = {
      text,
      text + "\n[solver]\ntolerance = 1e-11 # fine\n",
      text + "\n[solver]\n",
      text.substr(0, units) + "solver = { tolerance = 1.0e-11 }\n" + text.substr(units),
      text.substr(0, units) + "solver.tolerance = 1_0e-12\n" + text.substr(units),
  };
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    SCOPED_TRACE(k);
    Diagnostics out;
    const std::string file = folder_.write("coarse.toml", scenes[k]);
    const auto prepared = prepare(file, out);
    ASSERT_TRUE(prepared) << test::messages(out);
    const AccuracySetting setting{.tolerance = 1e-10};
    const auto files = chosen_scene(file, *prepared, setting, folder_ / "out", out);
    ASSERT_EQ(files.size(), 1u) << test::messages(out);
    const auto written = parse_scene(files[0].second, "written.toml", out);
    ASSERT_TRUE(written) << test::messages(out);
    EXPECT_EQ(written->solver.tolerance, 1e-10);
    EXPECT_EQ(k == 1, files[0].second.find("# fine") != std::string::npos);
    const auto trial = with_setting(*prepared, setting);
    ContactField field(trial->model);
    EXPECT_EQ(solve(*trial, field, {}).poses.to_csv(), test::solved(*written).poses.to_csv());
  }
}

TEST_F(Accuracy, CountsErrorsFromAFinerToleranceThanTheScenes) {
  const std::string scene = folder_.write("coarse.toml", test::read_file(knee()) + "\n[solver]\ntolerance = 1e-3\n");
  ASSERT_EQ(run(scene, {}), kExitOk) << test::messages(out_);
  EXPECT_LT(worst(report_.points[0], "position"), 1e-6) << "no looser than contacts and events need";
  ASSERT_NE(point("tolerance 1e-12"), nullptr);
  EXPECT_EQ(worst(*point("tolerance 1e-12"), "position"), 0);
  EXPECT_EQ(point("tolerance 1e-10"), nullptr) << "that is the scene as it is";
}

TEST_F(Accuracy, TimeIsToldApart) {
  ASSERT_EQ(run(knee(), {}), kExitOk) << test::messages(out_);
  int disturbed = 0;  // by other programs, in the middle of what stands for sixteen calls
  for (const AccuracyPoint& p : report_.points) {
    double sum = 0;
    for (const double seconds : p.effect_seconds) sum += seconds;
    EXPECT_GT(sum, 0) << p.name;
    if (sum > 1.1 * p.pose_seconds) ++disturbed;
    EXPECT_EQ(p.effect_seconds[0] > 0, p.setting.modulus == 0) << p.name << ": layers search for nothing";
  }
  EXPECT_LE(disturbed, 3);
  EXPECT_NE(to_csv(report_).find(",us_search,us_contact_equations,us_ligaments,"), std::string::npos);
}

TEST_F(Accuracy, SaysThatATargetIsOutOfReach) {
  EXPECT_EQ(run(knee(), {"1e-9mm"}), kExitIncomplete);
  EXPECT_EQ(report_.chosen, -1);
  EXPECT_NE(report_.sentence.find("No setting"), std::string::npos);
}

TEST_F(Accuracy, RefusesToWriteAnewWhatHasNoTableOfItsOwn) {
  // The first surface as one line of a table of all surfaces.
  const std::string text = test::read_file(knee());
  const std::size_t first = text.find("[surface.femur_medial]"), last = text.find("[surface.", first + 1);
  std::string members;
  std::istringstream lines(text.substr(first, last - first));
  std::string line;
  for (std::getline(lines, line); std::getline(lines, line);)
    if (line.find(" = ") != std::string::npos && line[0] != '#') members += (members.empty() ? "" : ", ") + line;
  const std::string scene =
      folder_.write("inline.toml", text.substr(0, text.find("[body")) + "surface.femur_medial = {" + members + "}\n" +
                                       text.substr(text.find("[body"), first - text.find("[body")) + text.substr(last));
  EXPECT_EQ(run(scene, {"0.01mm"}), kExitRefused);
  ASSERT_EQ(out_.items().size(), 1u) << test::messages(out_);
  EXPECT_EQ(out_.items()[0].key, "surface.femur_medial");
  EXPECT_GT(out_.items()[0].line, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  EXPECT_EQ(run(scene, {}), kExitOk) << "nothing is to be written anew: " << test::messages(out_);
}

TEST_F(Accuracy, RefusesToWriteATolerance) {
  const std::string text = test::read_file(knee());
  const std::string scene = folder_.write("inline.toml", "solver = {}\n" + text);
  EXPECT_EQ(run(scene, {"0.01mm"}), kExitRefused);
  ASSERT_EQ(out_.items().size(), 1u) << test::messages(out_);
  EXPECT_EQ(out_.items()[0].key, "solver");
  EXPECT_EQ(out_.items()[0].line, 1);
}

TEST_F(Accuracy, IsSilentAboutWhatWasCalledOff) {
  RunOptions options;
  int asked = 0;
  options.cancelled = [&] { return ++asked > 100; };
  EXPECT_EQ(run_accuracy(knee(), folder_ / "out", {{}, 1, 60}, options, out_, report_, own_), kExitIncomplete);
  EXPECT_TRUE(report_.points.empty());
  EXPECT_NE(test::messages(out_).find("interrupted"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(Accuracy, RefusesTargetsThatAreNone) {
  for (const char* bad : {"", "mm", "0mm", "-1mm", "nan mm", "1e400mm", "0.1", "0.1 m", "x0.1mm", "1,5mm"}) {
    EXPECT_EQ(run(knee(), {bad}), kExitRefused) << bad;
    ASSERT_EQ(out_.items().size(), 1u) << bad;
    EXPECT_EQ(out_.items()[0].key, "--target");
  }
  EXPECT_EQ(run(knee(), {"1mm", "2mm"}), kExitRefused);
  EXPECT_EQ(run(genu::test::source_folder() + "/meshes/leskovar2019/scene.toml", {}), kExitRefused);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

}  // namespace
}  // namespace genu
