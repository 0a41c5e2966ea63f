#include "genu/study/run_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "genu/core/file_list.h"
#include "genu/mesh_files/stl_writer.h"
#include "genu/model/build_model.h"
#include "genu/scene/reader.h"
#include "genu/surface/analytic.h"
#include "support/judged.h"
#include "support/scenes.h"
#include "support/text.h"

namespace genu {
namespace {

using test::read_file;

Scene dortmans() {
  Diagnostics out;
  auto scene = read_scene(test::dortmans_file(), out);
  EXPECT_TRUE(scene.has_value()) << test::messages(out);
  return scene.value_or(Scene{});
}

int run(const std::string& scene, const std::string& folder, Diagnostics& out) {
  return test::judged_run(scene, folder, {}, out, nullptr);
}

TEST(RunScene, WritesTheSameBytesTwiceAndReplacesTheFolderAsAWhole) {
  test::TemporaryFolder folder;
  Diagnostics out;
  ASSERT_EQ(run(test::dortmans_file(), folder / "a", out), kExitOk) << test::messages(out);
  folder.write("a/left over.txt", "from an earlier version");
  ASSERT_EQ(write_file_list(folder / "a", "results"), "");
  folder.write("a/notes.txt", "mine");
  const std::string first = read_file(folder / "a/results.csv"), curves = read_file(folder / "a/curves.svg");
  ASSERT_EQ(run(test::dortmans_file(), folder / "a", out), kExitOk);
  EXPECT_EQ(std::count(first.begin(), first.end(), '\n'), 72);
  EXPECT_EQ(read_file(folder / "a/results.csv"), first);
  EXPECT_EQ(read_file(folder / "a/curves.svg"), curves);
  EXPECT_FALSE(std::filesystem::exists(folder / "a/left over.txt"));
  EXPECT_EQ(read_file(folder / "a/notes.txt"), "mine");
}

TEST(RunScene, ColumnsAreThoseOfTheSceneReference) {
  Scene scene = dortmans();
  scene.ligaments.resize(1);
  scene.steps[0].prescribe.push_back({{0, 3}, 0, 0});
  scene.contacts[1].regions.push_back({"inner", {}});
  std::string columns;
  const ResultTable poses = test::solved(scene).poses;
  for (const std::string& name : poses.columns()) columns += name + " ";
  const std::string medial =
      "medial.force_N medial.gap_mm medial.femur_medial.x_mm medial.femur_medial.y_mm medial.femur_medial.z_mm "
      "medial.tibia_medial.x_mm medial.tibia_medial.y_mm medial.tibia_medial.z_mm ";
  EXPECT_EQ(
      columns.find(
          "step increment time_s status knee.flexion_deg knee.adduction_deg knee.rotation_deg knee.x_mm knee.y_mm "
          "knee.z_mm knee.flexion.reaction_Nm knee.x.reaction_N knee.gs.flexion_deg knee.gs.adduction_deg "
          "knee.gs.external_rotation_deg knee.gs.lateral_mm knee.gs.anterior_mm knee.gs.distraction_mm " +
          medial + "lateral.force_N "),
      0u)
      << columns;
  const std::string end =
      "lateral.inner.force_N lateral.inner.points lateral.inner.x_mm lateral.inner.y_mm lateral.inner.z_mm "
      "AAC.length_mm AAC.strain AAC.force_N stability.min_eigenvalue_Nmm stability newton.iterations residual branch ";
  EXPECT_TRUE(columns.ends_with(end)) << columns;
}

/// A meshed ball in a meshed bowl, rolled by 4 deg while a spring and a load press it down.
std::string ball_in_bowl_scene(const test::TemporaryFolder& folder) {
  const auto mesh = [&](const std::string& name, double radius) {
    const Mesh ball = make_ellipsoid({}, {radius, 1.1 * radius, 0.95 * radius}, false)->triangles(1.5e-3, {}, 0.1);
    EXPECT_EQ(write_stl(ball, folder / (name + ".stl"), 1e-3, name), "");
    return "[surface." + name + "]\nshape = \"mesh\"\nfile = \"" + name + ".stl\"\nunits = \"mm\"\n";
  };
  return folder.write("scene.toml",
                      "format = 1\nunits = { length = \"mm\", angle = \"deg\" }\n[body.ground]\nfixed = true\n"
                      "[body.bone]\n[joint.j]\ntype = \"free\"\nparent = \"ground\"\nchild = \"bone\"\n"
                      "rotations = [\"a x\", \"b y\", \"c z\"]\ntranslations = [\"x\", \"y\", \"z\"]\n"
                      "reference = { z = -9.5 }\n" +
                          mesh("ball", 0.01) + "body = \"bone\"\n" + mesh("bowl", 0.02) +
                          "body = \"ground\"\ninside = true\n"
                          "[contact.foot]\nsurfaces = [\"ball\", \"bowl\"]\nmodel = \"rigid\"\n"
                          "[load.weight]\nbody = \"bone\"\nforce = [0, 0, -10]\n"
                          "[[step]]\nprescribe = { \"j.a\" = [0, 4], \"j.b\" = 0, \"j.c\" = 0 }\nincrements = 4\n");
}

TEST(RunScene, WritesTheSameBytesWhateverTheNumberOfThreads) {
  const test::TemporaryFolder folder;
  const std::string scene = ball_in_bowl_scene(folder);
  std::string csv[2];
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const std::string out_folder = folder / std::to_string(threads);
    Diagnostics out;
    ASSERT_EQ(run(scene, out_folder, out), kExitOk) << test::messages(out);
    csv[threads - 1] = read_file(out_folder + "/results.csv");
  }
  EXPECT_EQ(std::count(csv[0].begin(), csv[0].end(), '\n'), 6);
  EXPECT_TRUE(csv[0] == csv[1]);
}

TEST(RunScene, ARefusedSceneLeavesTheEarlierResult) {
  test::TemporaryFolder folder;
  Diagnostics out;
  ASSERT_EQ(run(test::dortmans_file(), folder / "a", out), kExitOk);
  const std::string before = read_file(folder / "a/summary.json");
  EXPECT_EQ(run(folder.write("bad.toml", "format = 1\nspeed = 2\n"), folder / "a", out), kExitRefused);
  EXPECT_TRUE(out.has_errors());
  EXPECT_EQ(read_file(folder / "a/summary.json"), before);
}

TEST(RunScene, AFileOfTheUsersInTheWayIsToldBeforeAnythingIsComputed) {
  test::TemporaryFolder folder;
  Diagnostics out;
  ASSERT_EQ(run(test::dortmans_file(), folder / "a", out), kExitOk);
  folder.write("a/report.html", "mine");
  EXPECT_EQ(run(test::dortmans_file(), folder / "a", out), kExitOk);  // no report is asked for
  RunOptions options;
  options.report = true;
  bool computed = false;
  options.progress = [&](int, int) { computed = true; };
  EXPECT_EQ(test::judged_run(test::dortmans_file(), folder / "a", options, out, nullptr), kExitRefused);
  EXPECT_FALSE(computed);
  EXPECT_TRUE(test::contains(test::messages(out), "report.html: was not written by genu"));
  EXPECT_EQ(read_file(folder / "a/report.html"), "mine");
}

TEST(RunScene, RefusesAFolderThatIsNotItsOwnOrNotWritable) {
  test::TemporaryFolder folder;
  Diagnostics out;
  std::filesystem::create_directory(folder / "foreign");
  folder.write("foreign/thesis.txt", "kept");
  EXPECT_EQ(run(test::dortmans_file(), folder / "foreign", out), kExitRefused);
  EXPECT_EQ(read_file(folder / "foreign/thesis.txt"), "kept");
  EXPECT_EQ(run(test::dortmans_file(), "/proc/genu/out", out), kExitRefused);
  EXPECT_EQ(out.count(Diagnostic::Severity::error), 2u) << test::messages(out);
}

TEST(RunScene, ACancelledRunKeepsItsRows) {
  test::TemporaryFolder folder;
  Diagnostics out;
  int rows = 0;
  RunOptions options;
  options.progress = [&](int done, int) { rows = done; };
  options.cancelled = [&] { return rows >= 10; };
  Solution solution;
  EXPECT_EQ(test::judged_run(test::dortmans_file(), folder / "a", options, out, &solution), kExitIncomplete);
  EXPECT_GE(solution.summary.poses_solved, 10);
  EXPECT_LT(solution.summary.poses_solved, 71);
  EXPECT_TRUE(std::filesystem::exists(folder / "a.partial/results.partial.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a"));  // nobody takes a part for the whole
}

/// The scene's text with every length of it in metres.
std::string in_metres(const std::string& text) {
  static const std::regex length("^(origin|major_radius|minor_radius|reference|from|to) ="),
      number("-?[0-9]+[.]?[0-9]*");
  std::istringstream lines(text);
  std::string out;
  for (std::string line; std::getline(lines, line); out += line + "\n") {
    if (line.starts_with("units")) line = "units = { length = \"m\", angle = \"deg\" }";
    if (!std::regex_search(line, length)) continue;
    std::string scaled;
    std::size_t done = 0;
    for (auto n = std::sregex_iterator(line.begin(), line.end(), number); n != std::sregex_iterator(); ++n) {
      const auto at = static_cast<std::size_t>(n->position());
      scaled += line.substr(done, at - done) + fmt::format("{:.17g}", std::stod(n->str()) * 1e-3);
      done = at + n->str().size();
    }
    line = scaled + line.substr(done);
  }
  return out;
}

TEST(RunScene, MetresAndMillimetresAreTheSameKnee) {
  Diagnostics out;
  const auto metres = parse_scene(in_metres(read_file(test::dortmans_file())), "metres.toml", out);
  ASSERT_TRUE(metres.has_value()) << test::messages(out);
  ASSERT_EQ(metres->length_unit, 1);
  const ResultTable a = test::solved(dortmans()).poses, b = test::solved(*metres).poses;
  for (const char* column : {"knee.rotation_deg", "knee.adduction_deg", "knee.y_mm", "medial.force_N", "AAC.strain"})
    EXPECT_LT(test::worst_difference(a, b, column), 1e-10) << column;
}

/// Both bodies described in other frames: what is fixed moved by X, what moves turned about its origin. A pose (R, d)
/// becomes (Q R Q', Q d + p) with X = (Q, p), so turned axes give the same angles.
double worst_residual(const ResultTable& poses) {
  double worst = 0;
  for (std::size_t row = 0; row < poses.rows(); ++row) worst = std::max(worst, poses.number(row, "residual"));
  return worst;
}

TEST(RunScene, PosesAreSolvedAsExactlyAsTheSceneAsksFor) {
  const std::string text = read_file(test::dortmans_file());
  const auto with = [&](const std::string& tolerance) {
    return test::table_of(text + "\n[solver]\ntolerance = " + tolerance + "\n");
  };
  const ResultTable own = test::table_of(text), coarse = with("1e-10"), fine = with("1e-14");
  EXPECT_EQ(SolverDef{}.tolerance, NewtonOptions{}.residual_tolerance);
  EXPECT_EQ(own.to_csv(), with("1e-12").to_csv());
  EXPECT_LE(worst_residual(own), 1e-12);
  EXPECT_LE(worst_residual(coarse), 1e-10);
  EXPECT_GT(worst_residual(coarse), 1e-12);
  EXPECT_EQ(coarse.to_csv(), with("1e-3").to_csv()) << "no looser than contacts and events need";
  EXPECT_LT(worst_residual(fine), 1e-12);
  EXPECT_GT(test::worst_difference(own, coarse, "knee.x_mm"), 0);
  EXPECT_LT(test::worst_difference(own, coarse, "knee.x_mm"), 1e-8);
}

TEST(RunScene, AKneeMovedInSpaceIsTheSameKnee) {
  const Scene here = dortmans();
  Scene there = here;
  const Pose X{exp_rotation(Vec3(0.7, -1.1, 2.0)), Vec3(0.3, -0.2, 0.5)}, Q{X.R, Vec3::Zero()};
  const auto frame = [&](int body) { return here.bodies[static_cast<std::size_t>(body)].fixed ? X : Q; };
  for (SurfaceDef& s : there.surfaces) s.placement = frame(s.body) * s.placement;
  for (LigamentDef& l : there.ligaments)
    for (LigamentDef::End* end : {&l.from, &l.to}) end->point = frame(end->body) * end->point;
  JointDef& joint = there.joints.at(0);
  for (auto& r : joint.rotations) r.axis = X.R * r.axis;
  const Vec3 origin = X * Vec3(joint.reference[3], joint.reference[4], joint.reference[5]);
  std::copy(origin.begin(), origin.end(), joint.reference.begin() + 3);
  const ResultTable a = test::solved(here).poses, b = test::solved(there).poses;
  for (const char* column : {"knee.rotation_deg", "knee.adduction_deg", "knee.flexion.reaction_Nm", "medial.force_N",
                             "lateral.force_N", "AAC.length_mm", "PMC.force_N"})
    EXPECT_LT(test::worst_difference(a, b, column), 1e-8) << column;
}

TEST(RunScene, AStartThatOverlapsDeeplyIsRefusedALittleIsSolved) {
  Scene scene = dortmans();
  for (const auto& [lower, good] : {std::pair{5.9e-3, true}, {6.1e-3, false}}) {
    Diagnostics out;
    Scene lowered = scene;
    lowered.joints[0].reference[5] -= lower;
    const auto p = prepare(lowered, std::make_shared<MeshLibrary>(), out);
    ASSERT_TRUE(p.has_value()) << test::messages(out);
    ContactField field(p->model);
    EXPECT_EQ(check_start(*p, field, out), good) << lower;
    EXPECT_EQ(out.count(Diagnostic::Severity::error), good ? 0u : 2u) << test::messages(out);  // one for each condyle
  }
}

}  // namespace
}  // namespace genu
