#include "genu/sweep/read_sweep.h"

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/text.h"
#include "sweep/ball.h"

namespace genu {
namespace {

std::optional<SweepDef> read(const test::TemporaryFolder& folder, const std::string& text, std::string& said) {
  Diagnostics out;
  InputFiles files;
  auto sweep = read_sweep(folder.write("study.toml", text), files, out);
  said = test::messages(out);
  return sweep;
}

const std::string kWhole = R"(format = 1
title = "all keys"
scenes = ["a.toml", "more/*.toml"]
samples = 10
seed = 3
design = "sobol"
indices = true
[vary]
"A.stiffness" = { normal = 100, sd = 10, truncated = [50, 200] }
"B*.stiffness+C.stiffness:together" = { lognormal = 1, sd = 0.2, relative = true }
"D.slack_length" = { uniform = [-1, 1], add = true }
"E.stiffness" = { values = [1, 2], weights = [1, 3] }
[what_if.cut]
without = "ACL*"
[what_if.soft]
set = ["MCL.stiffness=x0.5"]
[[keep]]
columns = ["knee.x", "ACL*.force"]
at = ["all", 30, "max"]
)";

TEST(ReadSweep, ReadsEveryKey) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "more");
  folder.write("more/c.toml", "");
  folder.write("more/b.toml", "");
  std::string said;
  const auto s = read(folder, kWhole, said);
  ASSERT_TRUE(s) << said;
  ASSERT_EQ(s->scenes.size(), 3u);
  EXPECT_TRUE(s->scenes[1].path.ends_with("more/b.toml"));  // sorted
  EXPECT_EQ(s->design, DesignKind::sobol);
  EXPECT_EQ(s->samples, 10u);
  EXPECT_EQ(s->seed, 3u);
  EXPECT_TRUE(s->indices);
  ASSERT_EQ(s->vary.size(), 4u);
  EXPECT_EQ(s->vary[0].distribution.high, 200);
  EXPECT_TRUE(s->vary[1].together);
  EXPECT_EQ(s->vary[1].patterns, (std::vector<std::string>{"B*.stiffness", "C.stiffness"}));
  EXPECT_EQ(s->vary[1].how, VaryDef::How::relative);
  EXPECT_EQ(s->vary[2].how, VaryDef::How::added);
  EXPECT_EQ(s->vary[3].distribution.weights, (std::vector<double>{1, 3}));
  ASSERT_EQ(s->what_ifs.size(), 3u);
  EXPECT_EQ(s->what_ifs[1].changes.without, std::vector<std::string>{"ACL*"});
  EXPECT_EQ(s->what_ifs[2].changes.set, std::vector<std::string>{"MCL.stiffness=x0.5"});
  EXPECT_EQ(s->keep[0].rows[1].value, 30);
}

TEST(ReadSweep, SaysEverythingThatIsWrongWithItsPlace) {
  const test::TemporaryFolder folder;
  std::string said;
  EXPECT_FALSE(read(folder,
                    R"(format = 1
scene = "a.toml"
samples = 0
sed = 3
design = "random"
[vary]
"A.stiffness" = { normal = 1, sd = -1, relative = true, add = true }
"B.stiffness" = { uniform = [2, 1] }
"C.stiffness+D.stiffness" = { lognormal = -1, sd = 1 }
"E.stiffness" = { sd = 1 }
"F.stiffness" = { values = [1, 2], weights = [1] }
"G.stiffness" = { normal = 1, sd = 0.01, truncated = [5, 6] }
[correlation]
factors = ["A.stiffness", "B.stiffness"]
matrix = [[1, 1.5], [1.5, 1]]
[what_if.nothing]
[[keep]]
columns = "x"
at = "first"
)",
                    said));
  for (const char* place : {":3:11: samples = 0:", ":4:1: sed", ":5:10: design = \"random\"",
                            ":7:", ":8:29:", ":9:1:", ":10:", ":11:", ":12:", ":15:10: correlation.matrix",
                            "smallest eigenvalue is -0.5", ":16:", ":19:6: keep[1].at = \"first\""})
    EXPECT_TRUE(test::contains(said, place)) << place << "\n" << said;
}

TEST(ReadSweep, RefusesKeysThatTheDesignDoesNotUse) {
  const test::TemporaryFolder folder;
  std::string said;
  EXPECT_FALSE(
      read(folder,
           "format = 1\nscene = \"a\"\nsamples = 5\npoints = \"p.csv\"\ndesign = \"factorial\"\nindices = true\n"
           "[[keep]]\ncolumns = \"x\"\nat = \"last\"\n",
           said));
  EXPECT_TRUE(test::contains(said, "samples = 5: has no effect")) << said;
  EXPECT_TRUE(test::contains(said, "belongs to the design points")) << said;
  EXPECT_TRUE(test::contains(said, "needs the design monte_carlo or sobol")) << said;
}

TEST(ReadSweep, RefusesDesignsThatHaveNothingToCombine) {
  const test::TemporaryFolder folder;
  const std::string head = "format = 1\nscene = \"a\"\ndesign = \"factorial\"\n";
  const std::string tail = "[[keep]]\ncolumns = \"x\"\nat = \"last\"\n";
  std::string said;
  EXPECT_FALSE(read(folder, head + tail, said));
  EXPECT_TRUE(test::contains(said, "vary: must be given: the design combines values of varied numbers")) << said;
  EXPECT_FALSE(read(folder, head + "probabilities = [0.5, 0.5]\n" + tail, said));
  EXPECT_TRUE(test::contains(said, "must rise from one to the next")) << said;
}

TEST(ReadSweep, SaysWhatIsWrongWithAnEvent) {
  const test::TemporaryFolder folder;
  const auto said = [&](const std::string& event) {
    Diagnostics out;
    EXPECT_FALSE(prepare_sweep(test::ball_study(folder, "samples = 2\n", test::kBallVary + event), out));
    return test::messages(out);
  };
  for (const char* when : {"j.z", "j.z > ", "> 2", "j.z > two", "j.z >= 2", "j.z > nan", "j.z < inf"})
    EXPECT_TRUE(test::contains(said(std::string("[event.e]\nwhen = \"") + when + "\"\n"),
                               "must be a column, < or >, and a number"))
        << when;
  EXPECT_TRUE(test::contains(said("[event.e]\nwhen = \"j.zz > 2\"\n"), "is no column of results.csv"));
  EXPECT_TRUE(test::contains(said("[event.e]\nwhen = \"j.z > 2\"\nat = \"all\"\n"), "must be one row"));
  EXPECT_TRUE(test::contains(said("[event.e]\nwhen = \"j.z > 2\"\nat = 77\n"), "goes from 0 to 10"));
  EXPECT_TRUE(test::contains(said("[event.jumped]\nwhen = \"j.z > 2\"\n"), "is an event that every study has"));
}

TEST(ReadSweep, TellsASceneFromAStudy) {
  Diagnostics out;
  InputFiles files;
  EXPECT_FALSE(read_sweep(test::dortmans_file(), files, out));
  EXPECT_TRUE(test::contains(test::messages(out), "is a scene: a study names one")) << test::messages(out);
}

}  // namespace
}  // namespace genu
