// genu, run as a user runs it: what works, what is refused and how, and what is kept of a run that stops.
#include <cctype>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/meshed_ball.h"
#include "support/places.h"
#include "tools/cli_scenes.h"

namespace genu::test {
namespace {

TEST(Cli, SaysWhatItIs) {
  EXPECT_EQ(genu("").exit_code, 2);
  EXPECT_TRUE(contains(genu("").out, "genu run SCENE --out DIR"));
  for (const char* command : {"", "run ", "check ", "evaluate ", "sensitivity ", "mesh "})
    EXPECT_EQ(genu(std::string(command) + "--help").exit_code, 0) << command;
  EXPECT_EQ(genu("help").out, genu("--help").out);
  EXPECT_EQ(genu("help run").out, genu("run --help").out);
  EXPECT_TRUE(contains(genu("compar").err, "did you mean \"compare\"?"));
  EXPECT_TRUE(contains(genu("rnu").err, "did you mean \"run\"?"));
  EXPECT_TRUE(contains(genu("hlep").err, "did you mean \"help\"?"));
  EXPECT_TRUE(contains(genu("lax").err, "did you mean \"laxity\"?")) << "its beginning";
  const Outcome option = genu("run ball.toml --otu=out");
  EXPECT_EQ(option.exit_code, 2);
  EXPECT_TRUE(contains(option.err, "genu run has no option --otu; did you mean \"--out\"?")) << option.err;
  EXPECT_TRUE(contains(genu("run one.toml two.toml").err, "two.toml")) << "what is no option is named as it is";
  EXPECT_EQ(genu("--version").exit_code, 0);
  EXPECT_EQ(genu("--version").out.rfind("genu ", 0), 0u);
}

TEST(Cli, SolvesChecksAndMeshes) {
  TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", kBall);
  const Outcome run = genu("run " + scene + " --out " + (folder / "deep/er/out"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(contains(run.out, "Every pose is solved and certified")) << run.out;
  EXPECT_TRUE(contains(run.out, "curves.svg, report.html, summary.json")) << run.out;
  for (const char* file : {"results.csv", "events.csv", "curves.svg", "report.html", "summary.json"})
    EXPECT_TRUE(std::filesystem::file_size(folder / (std::string("deep/er/out/") + file)) > 0) << file;
  EXPECT_EQ(genu("run " + scene + " --quiet --out " + (folder / "out")).out, "");
  const Outcome check = genu("check " + scene);
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_TRUE(contains(check.out, "no errors"));
  EXPECT_EQ(genu("mesh " + scene + " --edge 4 --out " + (folder / "meshes")).exit_code, 0);
}

TEST(Cli, SurfacesOfAnEarlierRunGiveTheSameResults) {
  TemporaryFolder folder;
  std::filesystem::create_directory(folder / "cache");
  const std::string scene = meshed_ball(folder);
  const auto run = [&](const std::string& more, const std::string& out) {
    return shell("XDG_CACHE_HOME=" + (folder / "cache ") + program() + " run " + scene + more + " --out " +
                 (folder / out));
  };
  const auto entries = [&] {
    const auto kept = std::filesystem::recursive_directory_iterator(folder / "cache");
    return std::count_if(begin(kept), end(kept), [](const auto& entry) { return entry.is_regular_file(); });
  };
  const Outcome anew = run(" --no-cache", "anew");
  EXPECT_EQ(anew.exit_code, 0) << anew.err;
  EXPECT_EQ(entries(), 0);
  const Outcome first = run("", "first"), second = run("", "second");
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(entries(), 1);
  for (const char* file : {"/results.csv", "/events.csv"}) {
    EXPECT_EQ(read_file(folder / (std::string("first") + file)), read_file(folder / (std::string("anew") + file)));
    EXPECT_EQ(read_file(folder / (std::string("second") + file)), read_file(folder / (std::string("anew") + file)));
  }
  EXPECT_EQ(second.err, anew.err);
}

TEST(Cli, ResultsHaveAUsualFolder) {
  TemporaryFolder folder;
  std::filesystem::create_directory(folder / "knee");
  folder.write("knee/scene-soft.toml", kBall);
  folder.write("ball.toml", kBall);
  const std::string at = "cd " + (folder / ".") + " && ";
  const Outcome ball = shell(at + program() + " run ball.toml"),
                knee = shell(at + program() + " run knee/scene-soft.toml");
  EXPECT_EQ(ball.exit_code, 0) << ball.err;
  EXPECT_TRUE(contains(ball.err, "results go to out/ball; another folder: --out DIR")) << ball.err;
  EXPECT_FALSE(contains(shell(at + program() + " run bal.toml").err, "results go to")) << "there is no such scene";
  EXPECT_TRUE(std::filesystem::exists(folder / "out/ball/results.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder / "out/knee-soft/report.html")) << knee.err;
  const Outcome changed = shell(at + program() + " run ball.toml --without front");
  EXPECT_EQ(changed.exit_code, 2) << "which is not that of a changed scene";
  EXPECT_TRUE(contains(changed.err, "need --out DIR")) << changed.err;
  EXPECT_EQ(ball.out.find('\x1b'), std::string::npos) << "colours where there is no terminal";
}

TEST(Cli, ATerminalHasColoursUnlessNoColorIsSet) {
  if (std::system("command -v script >/dev/null") != 0) GTEST_SKIP() << "script is not installed";
  TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", kBall);
  const auto said = [&](const std::string& before) {
    return shell(before + " script -qec '" + program() + " run " + scene + " --out " + (folder / "out") + "' /dev/null")
        .out;
  };
  EXPECT_TRUE(contains(said("TERM=xterm NO_COLOR="), "\x1b[32m  verdict"));
  EXPECT_EQ(said("TERM=xterm NO_COLOR=1").find("\x1b[32m"), std::string::npos);
}

TEST(Cli, TheSceneAsWrittenIsRunBesideTheChangedOne) {
  TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", kBall), run = "run " + scene + " --set front.stiffness=x0.5 ";
  const std::string intact = folder / "intact", cut = folder / "cut";
  const Outcome both = genu(run + "--beside " + intact + "/ --out " + cut + "/");
  EXPECT_EQ(both.exit_code, 0) << both.err;
  EXPECT_TRUE(std::filesystem::exists(cut + ".compared.html"));
  const Outcome same = genu(run + "--beside " + cut + "/ --out " + cut);
  EXPECT_EQ(same.exit_code, 2);
  EXPECT_TRUE(contains(same.err, "--beside and --out are the same folder")) << same.err;
  const Outcome columns = genu(run + "--beside " + intact + " --columns 'knee.flexion=angle' --out " + cut);
  EXPECT_EQ(columns.exit_code, 2);
  EXPECT_TRUE(contains(columns.err, "--beside names a folder")) << columns.err;
}

TEST(Cli, OfTwoRunsTheUnsolvedOneWeighsMost) {
  TemporaryFolder folder;
  // Doubtful as written, and without a spring the ball is not held.
  const std::string text = with_first(kBall, "[[step]]", "[plausible]\nligament_force = 1\n[[step]]");
  const std::string run = "run " + folder.write("ball.toml", text) + " --without 'f*,side,back' --beside " +
                          (folder / "intact") + " --out " + (folder / "cut") + " --save-failure " + (folder / "f.json");
  EXPECT_EQ(genu("run " + (folder / "ball.toml") + " --out " + (folder / "alone")).exit_code, 4);
  EXPECT_EQ(genu(run).exit_code, 3);
  EXPECT_TRUE(std::filesystem::exists(folder / "f.json"));
}

TEST(Cli, MeasuredCurvesStandBesideTheComputed) {
  TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", kBall), out = " --out " + (folder / "out");
  const std::string good = folder.write("m.csv", "angle,turn\n0,1\n0.1,nan\n"),
                    bad = folder.write("b.csv", "angle,turn\n0,x\n");
  const std::string columns = " --columns 'knee.flexion=angle[rad], knee.adduction=turn[deg]'";
  const Outcome run = genu("run " + scene + out + " --beside " + good + columns);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(contains(run.err, "1 cells hold no number and are left out of the report")) << run.err;
  EXPECT_TRUE(contains(read_file(folder / "out/report.html"), "\"beside\":[{\"name\":\"m.csv\""));
  const Outcome refused = genu("run " + scene + out + " --beside " + bad + columns);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(contains(refused.err, "b.csv:2:3: turn = \"x\": must be a number")) << refused.err;
  EXPECT_EQ(genu("run " + scene + out + " --columns 'knee.flexion=angle'").exit_code, 2);
}

TEST(Cli, DoesItsWorkWhereNothingCanBeSaid) {
  TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", kBall), program = genu::test::program();
  const auto exit_code = [](const std::string& command) {
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  for (const char* nowhere : {" 2>/dev/full", " 2>&-", " 2>/dev/null >&-", " >&- 2>&-"})
    EXPECT_EQ(exit_code(program + " run " + (folder / "none.toml") + " --out " + (folder / "out") + nowhere), 2)
        << nowhere;
  // Files that are opened must not take the place of a closed stream, and get what is printed.
  EXPECT_EQ(exit_code(program + " run " + scene + " --out " + (folder / "out") + " >&- 2>&-"), 1);
  ASSERT_EQ(genu("run " + scene + " --quiet --out " + (folder / "again")).exit_code, 0);
  EXPECT_EQ(read_file(folder / "out/results.csv"), read_file(folder / "again/results.csv"));
}

TEST(Cli, AnOptionIsNoNameOfAFolder) {
  TemporaryFolder folder;
  const Outcome refused = genu("run " + folder.write("ball.toml", kBall) + " --out --quiet");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(contains(refused.err, "--out names nothing")) << refused.err;
}

TEST(Cli, QuietSaysWhyARunIsNotWhole) {
  TemporaryFolder folder;
  std::string short_plate = kBall;
  const std::string plate = "shape = \"plane\"";
  short_plate.insert(short_plate.find(plate) + plate.size(), "\npatch = { x = [-30, 30], y = [-1, 1] }");
  const Outcome run = genu("run " + folder.write("short.toml", short_plate) + " --quiet --out " + (folder / "out"));
  ASSERT_EQ(run.exit_code, 3) << run.out << run.err;
  EXPECT_TRUE(contains(run.err, "poses are solved; those are certified and kept")) << run.err;
}

TEST(Cli, LeavesTheReportOutWhereItIsToldTo) {
  TemporaryFolder folder;
  const Outcome run = genu("run " + folder.write("ball.toml", kBall) + " --no-report --out " + (folder / "out"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_FALSE(contains(run.out, "report")) << run.out;
  EXPECT_FALSE(std::filesystem::exists(folder / "out/report.html"));
}

TEST(Cli, ComparesResults) {
  TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", kBall), a = folder / "a", b = folder / "b";
  ASSERT_EQ(genu("run " + scene + " --quiet --out " + a).exit_code, 0);
  ASSERT_EQ(genu("run " + scene + " --quiet --no-report --out " + b).exit_code, 0);
  const Outcome refused = genu("compare " + a + " " + b + " --out " + (folder / "both.html"));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(contains(refused.err, "b: holds no report.html")) << refused.err;
  ASSERT_EQ(genu("run " + scene + " --quiet --out " + b).exit_code, 0);
  const Outcome both = genu("compare " + a + " " + b + " --out " + (folder / "both.html"));
  EXPECT_EQ(both.exit_code, 0) << both.err;
  EXPECT_TRUE(contains(both.out, "both.html: 2 results compared")) << both.out;
  EXPECT_EQ(genu("compare " + a + " --out " + (folder / "one.html")).exit_code, 2);
}

TEST(Cli, SearchesFromSeveralStarts) {
  TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", kBall);
  const Outcome one = genu("run " + scene + " --out " + (folder / "one")),
                many = genu("run " + scene + " --starts 6 --out " + (folder / "many")),
                again = genu("run " + scene + " --starts 6 --out " + (folder / "again"));
  EXPECT_EQ(many.exit_code, 0) << many.err;
  EXPECT_TRUE(contains(many.out, "equilibria at the first pose: ")) << many.out;
  EXPECT_TRUE(contains(many.out, "from starts within 20 deg")) << many.out;
  EXPECT_TRUE(contains(many.out, "starts.csv")) << many.out;
  EXPECT_FALSE(contains(one.out, "starts")) << one.out;
  EXPECT_FALSE(std::filesystem::exists(folder / "one/starts.csv"));
  EXPECT_EQ(read_file(folder / "one/results.csv"), read_file(folder / "many/results.csv"));
  EXPECT_EQ(read_file(folder / "again/starts.csv"), read_file(folder / "many/starts.csv"));
  EXPECT_TRUE(contains(read_file(folder / "many/starts.csv"), "energy_Nmm"));
  EXPECT_EQ(genu("run " + scene + " --starts 0 --out " + (folder / "none")).exit_code, 2);
}

TEST(Cli, NamesTheOptionAndItsRule) {
  TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", kBall), out = " --out " + (folder / "out");
  const auto says = [](const Outcome& o, const std::string& part) { EXPECT_TRUE(contains(o.err, part)) << o.err; };
  says(genu("run " + scene + " --spread nan" + out), "--spread: nan is no number from 0.1 to 180");
  says(genu("fit --scene " + scene + " --margin inf" + out), "--margin: inf is no number from 0.5 to 100");
  says(genu("mesh " + scene + " --edge 0" + out), "--edge: 0 is no number from 1e-06 to 1e+06");
  says(genu("run " + scene + " --out ''"), "the output folder has no name");
  says(genu("fit " + (folder / "a.stl") + " --out ''"), "the output folder has no name");
}

TEST(Cli, WithoutMeshesThereAreNoErrorBars) {
  TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", kBall);
  const Outcome run = genu("run " + scene + " --error-bars --out " + (folder / "out"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(contains(run.out, "no error bars: the scene fits no smooth surface")) << run.out;
}

TEST(Cli, PressureMapsAreNamedOrSaidToBeNone) {
  TemporaryFolder folder;
  const std::string rigid = folder.write("ball.toml", kBall);
  const std::string soft = folder.write("soft.toml", with_first(kBall, "model = \"rigid\"",
                                                                "model = \"cartilage\"\nmodulus = 5\npoisson = 0.4\n"
                                                                "thickness = 4\nquadrature = \"triangles\"\n"
                                                                "cast_from = \"ball\""));
  const Outcome none = genu("run " + rigid + " --pressure-maps --out " + (folder / "rigid"));
  EXPECT_EQ(none.exit_code, 0) << none.err;
  EXPECT_TRUE(contains(none.out, "no pressure maps: the scene has no cartilage")) << none.out;
  const Outcome run = genu("run " + soft + " --pressure-maps --out " + (folder / "run"));
  EXPECT_TRUE(contains(run.out, "events.csv, pressures_medial.csv, curves.svg")) << run.out;
  const Outcome again = genu("evaluate " + soft + " --poses " + (folder / "run/results.csv") +
                             " --pressure-maps --out " + (folder / "again"));
  EXPECT_TRUE(contains(again.out, "results.csv, pressures_medial.csv, curves.svg")) << again.out;
}

TEST(Cli, AFitRadiusThatIsTooSmallIsNamedByItsKey) {
  TemporaryFolder folder;
  const std::string ball = folder.write("ball.toml", kBall);
  ASSERT_EQ(genu("mesh " + ball + " ball --edge 2 --out " + (folder / "m")).exit_code, 0);
  const std::string mesh = "shape = \"mesh\"\nfile = \"m/ball.stl\"\nunits = \"mm\"\nfit_radius = 0.1";
  const Outcome check =
      genu("check " + folder.write("mesh.toml", with_first(kBall, "shape = \"sphere\"\nradius = 20", mesh)));
  EXPECT_EQ(check.exit_code, 2);
  EXPECT_TRUE(contains(check.err, "surface.ball.fit_radius = 0.1 mm: must be at least")) << check.err;
}

TEST(Cli, DifferentiatesAScene) {
  TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", kBall), out = folder / "out";
  const Outcome good =
      genu("sensitivity " + scene + " --of knee.z medial.force --to '*.stiffness,ball.radius' --top 3 --out " + out);
  EXPECT_EQ(good.exit_code, 0) << good.err;
  EXPECT_TRUE(contains(good.out, "  1  ball.radius")) << good.out;
  EXPECT_TRUE(contains(good.out, "and 2 more")) << good.out;
  for (const char* file : {"results.csv", "sensitivity.csv", "ranking.csv", "sensitivity.svg"})
    EXPECT_TRUE(std::filesystem::file_size(out + "/" + file) > 0) << file;
  const std::string before = read_file(out + "/sensitivity.csv");
  const Outcome bad = genu("sensitivity " + scene + " --of knee.q --to front.stifness --out " + out);
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_TRUE(contains(bad.err, "did you mean \"front.stiffness\"?")) << bad.err;
  EXPECT_TRUE(contains(bad.err, "2 errors; nothing was computed")) << bad.err;
  EXPECT_EQ(read_file(out + "/sensitivity.csv"), before);
  EXPECT_EQ(genu("sensitivity " + scene + " --of knee.z").exit_code, 2);
}

struct Refusal {
  const char* piece;  ///< of the ball's scene
  const char* replacement;
  const char* said;  ///< part of the message, which also names the file, line and column
};

class CliRefuses : public testing::TestWithParam<Refusal> {};

TEST_P(CliRefuses, WithThePlaceAndLeavesTheEarlierResult) {
  TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", kBall), out = folder / "out";
  ASSERT_EQ(genu("run " + scene + " --out " + out).exit_code, 0);
  const std::string before = read_file(out + "/results.csv");
  const auto age = std::filesystem::last_write_time(out + "/results.csv");
  folder.write("ball.toml", with_first(kBall, GetParam().piece, GetParam().replacement));
  for (const std::string& command : {"run " + scene + " --out " + out, "check " + scene}) {
    const Outcome refused = genu(command);
    EXPECT_EQ(refused.exit_code, 2) << command << "\n" << refused.out << refused.err;
    EXPECT_TRUE(contains(refused.err, GetParam().said)) << refused.err;
    const std::size_t place = refused.err.find("ball.toml:");
    ASSERT_NE(place, std::string::npos) << refused.err;
    EXPECT_TRUE(std::isdigit(static_cast<unsigned char>(refused.err[place + 10]))) << refused.err;
  }
  EXPECT_EQ(read_file(out + "/results.csv"), before);
  EXPECT_EQ(std::filesystem::last_write_time(out + "/results.csv"), age);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / ""), {}), 2) << "something was left behind";
}

constexpr const char* kSphere = "shape = \"sphere\"\nradius = 20";
const Refusal kRefusals[] = {
    {"radius = 20", "radios = 20", "did you mean \"radius\""},
    {"radius = 20", "radius = \"20\"", "surface.ball.radius"},
    {"radius = 20", "radius = -20", "surface.ball.radius = -20"},
    {"radius = 20", "radius = 0", "surface.ball.radius = 0"},
    {"radius = 20", "radius = nan", "finite"},
    {"radius = 20", "radius = inf", "finite"},
    {"radius = 20", "radius = 1e400", "ball.toml:"},
    {"length = \"mm\"", "length = \"inch\"", "units.length"},
    {"stiffness = 20000", "stiffness = -2", "must be > 0"},
    {"point = [5, 30, -20]", "point = [5, nan, -20]", "finite"},
    {"point = [5, 30, -20]", "point = [5, 30]", "ligament.front.to.point"},
    {"from = { body = \"femur\", point = [0, 20, 0] }", "from = { body = \"fmur\", point = [0, 20, 0] }", "fmur"},
    {"point = [5, 30, -20]", "point = [0, 20, 20]", "ligament.front"},
    {"[ligament.back]", "[ligament.front]", "ball.toml:"},
    {"prescribe = { \"knee.flexion\" = [0, 10] }",
     "prescribe = { \"knee.flexion\" = 0, \"knee.adduction\" = 0, \"knee.rotation\" = 0, \"knee.x\" = 0, \"knee.y\" = "
     "0 }",
     "5"},
    {"prescribe = { \"knee.flexion\" = [0, 10] }", "prescribe = { \"knee.flexion\" = [0, inf] }", "finite"},
    {"prescribe = { \"knee.flexion\" = [0, 10] }", "prescribe = { \"knee.bend\" = [0, 10] }", "knee.bend"},
    {"increments = 5", "increments = 0", "step[1].increments"},
    {"increments = 5", "increments = 5.0", "step[1].increments"},
    {"format = 1", "format = 2", "format"},
    {"format = 1", "", "format"},
    {"title = \"ball on a plate\"", "title = \"ball", "ball.toml:2"},
    {"reference = { z = 20 }", "reference = { z = 13.9 }", "overlap by 6.1 mm"},
    {kSphere, "shape = \"mesh\"\nfile = \"none.stl\"\nunits = \"mm\"", "none.stl"},
    {kSphere, "shape = \"mesh\"\nfile = \".\"\nunits = \"mm\"", "surface.ball.file"},
    {"[[step]]", "[dynamics]\nduration = 1\n[[step]]", "has no steps"},
    {"model = \"rigid\"", "model = \"cartilage\"\nmodulus = 5", "contact.medial.poisson: is missing"},
    {"child = \"femur\"", "child = \"tibia\"", "joint.knee"},
};
INSTANTIATE_TEST_SUITE_P(Input, CliRefuses, testing::ValuesIn(kRefusals));

/// Meshes that no one can use, each as the ball's surface.
TEST(Cli, RefusesMeshesThatAreNone) {
  TemporaryFolder folder;
  std::string header(80, ' ');
  const std::string binary_without_triangles = header + std::string("\xe8\x03\0\0", 4) + std::string(100, '\1');
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  const std::pair<const char*, std::string> files[] = {{"noise.stl", "no mesh at all"},
                                                       {"empty.stl", ""},
                                                       {"none.stl", "solid a\nendsolid a\n"},
                                                       {"cut.stl", "solid a\n" + facet.substr(0, 60)},
                                                       {"binary.stl", binary_without_triangles},
                                                       {"single.stl", "solid a\n" + facet + "endsolid a\n"},
                                                       {"nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"},
                                                       {"index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"},
                                                       {"zeros.ply", std::string(1000, '\0')}};
  for (const auto& [name, bytes] : files) {
    folder.write(name, bytes);
    const std::string scene = folder.write(
        "ball.toml",
        with_first(kBall, kSphere, std::string("shape = \"mesh\"\nfile = \"") + name + "\"\nunits = \"mm\""));
    const Outcome refused = genu("run " + scene + " --out " + (folder / "out"));
    EXPECT_EQ(refused.exit_code, 2) << name << "\n" << refused.out << refused.err;
    EXPECT_TRUE(contains(refused.err, "ball.toml:17:") && contains(refused.err, name)) << refused.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "out")) << name;
  }
}

TEST(Cli, RefusesAMeshInTheWrongUnit) {
  TemporaryFolder folder;
  const std::string ball = folder.write("ball.toml", kBall);
  ASSERT_EQ(genu("mesh " + ball + " ball --edge 2 --unit mm --out " + (folder / "mm")).exit_code, 0);
  ASSERT_EQ(genu("mesh " + ball + " ball --edge 0.002 --unit m --out " + (folder / "m")).exit_code, 0);
  const auto with = [&](const std::string& file, const std::string& unit) {
    const std::string mesh = "shape = \"mesh\"\nfile = \"" + file + "/ball.stl\"\nunits = \"" + unit + "\"";
    return genu("run " + folder.write("mesh.toml", with_first(kBall, kSphere, mesh)) + " --quiet --out " +
                (folder / "out"));
  };
  EXPECT_EQ(with("mm", "m").exit_code, 2);
  const Outcome small = with("m", "mm");
  EXPECT_EQ(small.exit_code, 2);
  EXPECT_TRUE(contains(small.err, "mesh.toml:17:")) << small.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  EXPECT_EQ(with("mm", "mm").exit_code, 0) << with("mm", "mm").err;
  EXPECT_EQ(with("m", "m").exit_code, 0);
}

TEST(Cli, RefusesArguments) {
  TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", kBall), file = folder.write("file", "kept");
  std::filesystem::create_directory(folder / "foreign");
  folder.write("foreign/thesis.txt", "years of work");
  const std::string bad[] = {"run --out " + (folder / "out"),
                             "run " + scene + " --out",
                             "run " + scene + " --out ''",
                             "run " + scene + " --out " + file,
                             "run " + scene + " --out " + file + "/under",
                             "run " + scene + " --out " + (folder / "foreign"),
                             "run " + scene + " --out /",
                             "run " + scene + " --out /proc/genu",
                             "run " + scene + " --fast --out " + (folder / "out"),
                             "run " + scene + " " + scene + " --out " + (folder / "out"),
                             "run " + (folder / "none.toml") + " --out " + (folder / "out"),
                             "run " + (folder / "") + " --out " + (folder / "out"),
                             "run /dev/null --out " + (folder / "out"),
                             "run ''",
                             "run " + scene + " -out " + (folder / "out"),
                             "mesh-check " + scene + " --smooth nan",
                             "new knee --landmark-error nan",
                             "check " + (folder / "none.toml"),
                             "mesh " + scene + " --edge nan --out " + (folder / "out"),
                             "mesh " + scene + " --edge 1e300 --out " + (folder / "out"),
                             "mesh " + scene + " --edge 1 --reach 0 --out " + (folder / "out"),
                             "mesh " + scene + " --edge 1 --thickness nan --out " + (folder / "out"),
                             "mesh " + scene + " --edge 1 --out ''",
                             "run " + scene + " --spread nan --out " + (folder / "out"),
                             "run " + scene + " --spread 0 --out " + (folder / "out"),
                             "run " + scene + " --spread -20 --out " + (folder / "out"),
                             "run " + scene + " --starts 1e300 --out " + (folder / "out"),
                             "run " + scene + " --starts nan --out " + (folder / "out"),
                             "fit --scene " + scene + " --margin nan --out " + (folder / "out"),
                             "fit --scene " + scene + " --margin 1e300 --out " + (folder / "out"),
                             "mesh " + scene + " --edge -1 --out " + (folder / "out"),
                             "sensitivity " + scene + " --of knee.z --to '*.stiffness' --top 0",
                             "sensitivity " + scene + " --of knee.z --to '*.stiffness' --top=-1",
                             "sensitivity " + scene + " --of knee.z --to '*.stiffness' --top 99999999999999999999",
                             "sensitivity " + scene + " --of knee.z --to '*.stiffness' --top ''",
                             "run " + scene + " '--\x1b[31mred' --out " + (folder / "out"),
                             "'\x1b[31mred'",
                             "swim"};
  for (const std::string& arguments : bad) {
    const Outcome refused = genu(arguments);
    EXPECT_EQ(refused.exit_code, 2) << arguments << "\n" << refused.out << refused.err;
    EXPECT_FALSE(refused.err.empty()) << arguments;
    EXPECT_FALSE(contains(refused.err, "\x1b")) << "raw control characters: " << arguments;
    EXPECT_FALSE(std::filesystem::exists(folder / "out")) << arguments;
  }
  EXPECT_EQ(read_file(file), "kept");
  EXPECT_EQ(read_file(folder / "foreign/thesis.txt"), "years of work");
}

TEST(Cli, StopsWhereContactRunsOverTheEdgeOfAMesh) {
  TemporaryFolder folder;
  const std::string ball = folder.write("ball.toml", kBall);
  ASSERT_EQ(genu("mesh " + ball + " plate --edge 1 --reach 8 --out " + (folder / "m")).exit_code, 0);
  const std::string patch =
      with_first(kBall, "shape = \"plane\"", "shape = \"mesh\"\nfile = \"m/plate.stl\"\nunits = \"mm\"");
  const std::string scene = folder.write("patch.toml", with_first(patch, "[0, 10]", "0, \"knee.x\" = [0, 20]"));
  const Outcome stopped = genu("run " + scene + " --out " + (folder / "out"));
  EXPECT_EQ(stopped.exit_code, 3) << stopped.out << stopped.err;
  EXPECT_TRUE(contains(stopped.out, "3 of 6 poses are solved")) << stopped.out;  // x = 0, 4 and 8 mm
  EXPECT_TRUE(contains(stopped.out, "reaches the edge of plate at knee.x = 8 mm")) << stopped.out;
  EXPECT_TRUE(contains(read_file(folder / "out/results.csv"), ",over_edge,"));
}

struct Unsolved {
  const char* name;
  std::string scene;
  const char* status;
};

TEST(Cli, KeepsTheRowsOfARunThatStopsAndSaysWhy) {
  TemporaryFolder folder;
  std::string loose = kBall;  // nothing but a load that lifts
  loose.erase(loose.find("[ligament.front]"), loose.find("[[step]]") - loose.find("[ligament.front]"));
  const Unsolved cases[] = {
      {"loose", with_first(loose, "[[step]]", "[load.pull]\nbody = \"femur\"\nforce = [0, 0, 5]\n[[step]]"),
       "no_equilibrium"},
      {"sliding", with_first(loose, "[[step]]", "[load.push]\nbody = \"femur\"\nforce = [1, 0, -5]\n[[step]]"),
       "no_equilibrium"},
  };
  for (const Unsolved& c : cases) {
    const std::string scene = folder.write("scene.toml", c.scene), out = folder / c.name;
    const Outcome stopped = genu("run " + scene + " --out " + out);
    EXPECT_EQ(stopped.exit_code, 3) << c.name << "\n" << stopped.out << stopped.err;
    EXPECT_TRUE(contains(stopped.out, "of 6 poses are solved")) << stopped.out;
    const std::string csv = read_file(out + "/results.csv");
    EXPECT_TRUE(contains(csv, c.status) || contains(csv, "undetermined")) << csv;
    EXPECT_FALSE(contains(csv, "nan") || contains(csv, "inf")) << csv;
  }
}

}  // namespace
}  // namespace genu::test
