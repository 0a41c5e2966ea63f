// Whatever does not end well ends with what to do about it, and with something that helps: the section's own page, the
// status's own advice. That there is such a line at all, cli_scenes.h asserts of every command that any test runs.
#include <filesystem>
#include <set>

#include <gtest/gtest.h>

#include "tools/cli_scenes.h"

namespace genu::test {
namespace {

std::string advice_of(const Outcome& o) {
  const std::size_t at = o.err.find("what to do: ");
  return at == std::string::npos ? std::string() : o.err.substr(at);
}

struct Mistake {
  const char *piece, *by, *advice;
};

TEST(CliAdvice, NamesThePageOfTheSectionThatIsWrong) {
  const TemporaryFolder folder;
  const Mistake mistakes[] = {
      {"format = 1", "format = 2", "genu explain header"},
      {"length = \"mm\"", "length = \"inch\"", "genu explain units"},
      {"fixed = true", "fixd = true", "genu explain bodies"},
      {"child = \"femur\"", "child = \"fmur\"", "genu explain joints"},
      {"radius = 20", "radius = -20", "genu explain surfaces"},
      {"model = \"rigid\"", "model = \"soft\"", "genu explain contacts"},
      {"stiffness = 20000", "stiffness = -2", "genu explain ligaments"},
      {"[[step]]", "[load.pull]\nbody = \"femur\"\nforce = 3\n[[step]]", "genu explain loads"},
      {"increments = 5", "increments = 0", "genu explain steps"},
      {"title = \"ball on a plate\"", "title = \"ball", "TOML"},
      {"reference = { z = 20 }", "reference = { z = 13.9 }", "`start`"},
      {"shape = \"sphere\"\nradius = 20", "shape = \"mesh\"\nfile = \"none.stl\"\nunits = \"mm\"", "check the name"}};
  for (const Mistake& m : mistakes) {
    const Outcome refused = genu("check " + folder.write("ball.toml", with_first(kBall, m.piece, m.by)));
    EXPECT_EQ(refused.exit_code, 2) << m.by;
    EXPECT_TRUE(contains(advice_of(refused), m.advice)) << refused.err;
  }
}

TEST(CliAdvice, SaysEachThingOnceAndNoMoreThanThree) {
  const TemporaryFolder folder;
  std::string scene = with_first(kBall, "radius = 20", "radius = -20");
  for (const char* more : {"fixed = true", "model = \"rigid\"", "increments = 5", "law = \"quadratic\""})
    scene = with_first(scene, more, std::string("wrong = 1\n") + more);
  const Outcome refused = genu("check " + folder.write("ball.toml", with_first(scene, "strain = 0.05", "strain = -2")));
  EXPECT_EQ(occurrences(refused.err, "what to do: "), 3) << refused.err;
  const Outcome twice = genu(
      "check " + folder.write("two.toml", with_first(with_first(kBall, "[0, 20, 0]", "[0]"), "[0, -20, 0]", "[0]")));
  EXPECT_EQ(occurrences(twice.err, "what to do: "), 1) << twice.err;
}

/// Poses that are not found end with the advice of their own status.
TEST(CliAdvice, OfStatuses) {
  const TemporaryFolder folder;
  std::string loose = kBall;
  loose.erase(loose.find("[ligament.front]"), loose.find("[[step]]") - loose.find("[ligament.front]"));
  const auto with_load = [&](const std::string& force) {
    return with_first(loose, "[[step]]", "[load.pull]\nbody = \"femur\"\nforce = " + force + "\n[[step]]");
  };
  for (const auto& [scene, status] :
       {std::pair(with_load("[0, 0, 5]"), "no_equilibrium"), std::pair(with_load("[0, 0, -5]"), "undetermined")}) {
    const Outcome run = genu("run " + folder.write("a.toml", scene) + " --out " + (folder / "out"));
    EXPECT_EQ(run.exit_code, 3) << run.out;
    EXPECT_TRUE(contains(advice_of(run), std::string("genu explain ") + status)) << run.err;
  }
}

TEST(CliAdvice, OfCommands) {
  EXPECT_TRUE(contains(advice_of(genu("swim")), "genu --help"));
  EXPECT_TRUE(contains(genu("chek").err, "did you mean \"check\"?"));
  EXPECT_TRUE(contains(advice_of(genu("run")), "genu run --help"));
  EXPECT_TRUE(contains(advice_of(genu("mesh a.toml --edge x --out o")), "genu mesh --help"));
  EXPECT_TRUE(contains(advice_of(genu("run none.toml --out o")), "check the name"));
  EXPECT_EQ(genu("--version").err, "");
}

/// A mistake has the same advice, whatever its words hold.
TEST(CliAdvice, OfMistakesWhoseWordsMislead) {
  const TemporaryFolder folder;
  const std::string ball = folder.write("ball.toml", kBall);
  const std::string unnamed = folder.write("poses.csv", "knee.flexion,\n1,2\n");
  EXPECT_TRUE(contains(advice_of(genu("evaluate " + ball + " --poses " + unnamed + " --out " + (folder / "out"))),
                       "correct the table there"));
  const std::string meshed = folder.write(
      "meshed.toml",
      with_first(kBall, "shape = \"sphere\"\nradius = 20", "shape = \"mesh\"\nfile = \"a.stl\"\nunits = \"mm\""));
  folder.write("a.stl", "solid\nendsolid\n");
  EXPECT_TRUE(
      contains(advice_of(genu("mesh " + meshed + " ball --edge 1 --out " + (folder / "m"))), "genu mesh --help"));
  EXPECT_TRUE(contains(advice_of(genu("check " + meshed)), "genu mesh-check FILE"));
}

TEST(CliAdvice, OfFilesAndFolders) {
  const TemporaryFolder folder;
  const std::string ball = folder.write("ball.toml", kBall);
  const auto run_to = [&](const std::string& out) { return advice_of(genu("run " + ball + " --out " + out)); };
  EXPECT_TRUE(contains(run_to(ball), "name a folder with --out"));
  EXPECT_TRUE(contains(run_to("/proc/genu"), "name a place that you can write to"));
  std::filesystem::create_directory(folder / "theirs");
  folder.write("theirs/notes.txt", "x");
  EXPECT_TRUE(contains(run_to(folder / "theirs"), "move away what is there"));
  EXPECT_TRUE(contains(advice_of(genu("check " + (folder / "."))), "name the file in it"));
  EXPECT_TRUE(contains(advice_of(genu("check " + folder.write("latin.toml",
                                                              "title = \"Gelenkfl\xe4"
                                                              "che\""))),
                       "UTF-8"));
  EXPECT_TRUE(contains(advice_of(genu("judge " + (folder / "theirs"))), "with its results.csv and summary.json"));
  EXPECT_TRUE(contains(advice_of(genu("new " + (folder / "theirs"))), "choose a name that is not taken"));
}

}  // namespace
}  // namespace genu::test
