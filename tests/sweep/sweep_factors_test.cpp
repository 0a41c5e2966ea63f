#include "genu/sweep/sweep_factors.h"

#include <gtest/gtest.h>

#include "support/meshed_ball.h"
#include "support/text.h"
#include "sweep/ball.h"

namespace genu {
namespace {

/// What is refused of a study of the ball with these tables.
std::string factor_refusals(const std::string& tables, const std::string& head = "samples = 4\n") {
  const test::TemporaryFolder folder;
  Diagnostics out;
  EXPECT_FALSE(prepare_sweep(test::ball_study(folder, head, tables), out));
  return test::messages(out);
}

TEST(FindFactors, MakesOneOfEachNumberAndOneOfATogether) {
  const test::TemporaryFolder folder;
  const Sweep s = test::ready_sweep(test::ball_study(folder, "samples = 4\n", R"([vary]
"spring.from.*" = { normal = 0, sd = 1 }
"spring.stiffness+pull.force.z:together" = { uniform = [0.9, 1.1], relative = true }
)"));
  ASSERT_EQ(s.factors.size(), 4u);
  EXPECT_EQ(s.factors[0].name, "spring.from.x");
  EXPECT_EQ(s.factors[3].name, "spring.stiffness+pull.force.z:together");
  ASSERT_EQ(s.cases[0].factors.numbers[3].size(), 2u);
  const VariedNumber& stiffness = s.cases[0].factors.numbers[3][0];
  EXPECT_EQ(stiffness.base, 1000);
  EXPECT_EQ(number_at(stiffness, VaryDef::How::relative, 1.5), 1500);
  EXPECT_EQ(number_at(stiffness, VaryDef::How::added, 1.5), 1001.5);
  EXPECT_EQ(set_option(stiffness, VaryDef::How::absolute, 7.25), "spring.stiffness=7.25");
}

TEST(FindFactors, KnowsTheGroupOfEveryNumber) {
  const test::TemporaryFolder folder;
  const std::string study = test::ball_study(folder, "samples = 4\n", R"([vary]
"bushing.pad.stiffness.*" = { lognormal = 1, sd = 0.2, relative = true }
)");
  folder.write("ball.toml", test::kBallOnSpring +
                                "[bushing.pad]\nfrom = { body = \"ground\" }\nto = { body = \"ball\" }\n"
                                "stiffness = [1000, 1000, 1000]\nrotation_stiffness = [1, 1, 1]\n");
  EXPECT_EQ(test::ready_sweep(study).factors.size(), 3u);
  folder.write("study.toml", test::with_first(test::read_file(study), "bushing.pad", "body.pad"));
  Diagnostics out;
  EXPECT_FALSE(prepare_sweep(study, out));
  EXPECT_TRUE(test::contains(test::messages(out), "is no number of this scene")) << test::messages(out);
}

TEST(FindFactors, RefusesErrorsOfNoMesh) {
  const test::TemporaryFolder folder;
  const auto refused = [&](const std::string& error, const std::string& head = "samples = 4\n") {
    Diagnostics out;
    EXPECT_FALSE(prepare_sweep(test::meshed_ball_study(folder, head, error), out));
    return test::messages(out);
  };
  const std::string good = "{ sd = 0.02, correlation_length = 15 }", at = "study.toml:5:";
  const auto has = [](const std::string& said, const std::string& what) {
    EXPECT_TRUE(test::contains(said, what)) << said;
  };
  has(refused("{ sd = 0, correlation_length = 15 }"), at + "28: vary.skin.mesh_error.sd = 0: must be > 0");
  has(refused("{ sd = 1, correlation_length = -1 }"), "vary.skin.mesh_error.correlation_length = -1: must be >= 0");
  has(refused("{ correlation_length = 1 }"), "vary.skin.mesh_error.sd");
  has(refused("{ normal = 1, sd = 1, correlation_length = 1 }"), "vary.skin.mesh_error.normal");
  has(refused("{ estimated = true, sd = 1 }"), "vary.skin.mesh_error.sd = 1: excludes `estimated`");
  has(refused("{ estimated = true }"), "sees no error in the mesh of skin: give sd and correlation_length");
  has(refused(good, "design = \"factorial\"\n"), "vary.skin.mesh_error: has no levels");
  has(refused(good + "\n\"skim.mesh_error\" = " + good),
      "study.toml:6:1: vary.skim.mesh_error = \"skim.mesh_error\": is no mesh of this scene; did you mean "
      "\"skin.mesh_error\"?");
  has(refused(good + "\n\"floor.mesh_error\" = " + good), "\"floor.mesh_error\": is no mesh of this scene");
  has(refused(good + "\n\"s*.mesh_error:together\" = " + good),
      "moves skin.mesh_error, which \"skin.mesh_error\" moves");
  has(refused(good + "\n\"s*.mesh_error+weight.force.z:together\" = " + good), "names meshes and numbers");
  has(refused(good + "\n\"weight.force.z\" = { normal = -50, sd = 1 }\n[correlation]\nfactors = [\"skin.mesh_error\", "
                     "\"weight.force.z\"]\nmatrix = [[1, 0], [0, 1]]"),
      "\"skin.mesh_error\": is no amount that could correlate");
  Diagnostics out;
  EXPECT_FALSE(
      prepare_sweep(test::ball_study(folder, "samples = 4\n", "[vary]\n\"skin.mesh_error\" = " + good + "\n"), out));
  has(test::messages(out), "\"skin.mesh_error\": names a mesh, and this scene has none");
}

TEST(FindFactors, RefusesWhatNamesNothing) {
  const std::string said =
      factor_refusals("[vary]\n\"sprin.stiffness\" = { normal = 0, sd = 1 }\n\"j.rz\" = { normal = 0, sd = 1 }\n");
  EXPECT_TRUE(
      test::contains(said, "study.toml:5:1: vary.sprin.stiffness = \"sprin.stiffness\": is no number of this scene"))
      << said;
  EXPECT_TRUE(test::contains(said, "did you mean \"spring.stiffness\"?")) << said;
  EXPECT_TRUE(test::contains(said, ":6:1: vary.j.rz = \"j.rz\": j.rz is no number of the file's tables")) << said;
}

TEST(FindFactors, RefusesNumbersThatTwoEntriesMove) {
  const std::string said = factor_refusals(
      "[vary]\n\"spring.stiffness\" = { values = [1] }\n\"*.stiffness:together\" = { values = [1], relative = true "
      "}\n");
  EXPECT_TRUE(test::contains(said, "moves spring.stiffness, which \"spring.stiffness\" moves already")) << said;
}

TEST(FindFactors, RefusesDistributionsThatCanReachImpossibleNumbers) {
  for (const char* entry : {"{ normal = 1000, sd = 200 }", "{ normal = 1, sd = 0.2, relative = true }",
                            "{ uniform = [-1, 1] }", "{ normal = 0, sd = 200, add = true }", "{ values = [1, 0] }"}) {
    const std::string said = factor_refusals(std::string("[vary]\n\"spring.stiffness\" = ") + entry + "\n");
    EXPECT_TRUE(test::contains(said, "and it must be > 0: use lognormal")) << said;
  }
  const test::TemporaryFolder folder;
  test::ready_sweep(test::ball_study(folder, "samples = 4\n", R"([vary]
"spring.stiffness" = { normal = 1000, sd = 200, truncated = [1, 2000] }
)"));
}

TEST(FactorsOfWhatIf, AreThoseThatAreStillThere) {
  const test::TemporaryFolder folder;
  const std::string two =
      test::kBallOnSpring +
      "[ligament.other]\nfrom = { body = \"ground\", point = [1, 0, 0] }\nto = { "
      "body = \"ball\", point = [1, 0, 0] }\nlaw = \"linear\"\nstiffness = 500\nslack_length = 10\n";
  const std::string study = test::ball_study(folder, "samples = 4\n", R"([vary]
"*.stiffness" = { lognormal = 1, sd = 0.2, relative = true }
[what_if.cut]
without = "other"
[what_if.stiff]
set = "other.stiffness=900"
)");
  folder.write("ball.toml", two);
  const Sweep s = test::ready_sweep(study);
  ASSERT_EQ(s.cases.size(), 3u);
  EXPECT_EQ(s.cases[0].factors.numbers[1].size(), 1u);
  EXPECT_TRUE(s.cases[1].factors.numbers[1].empty());
  EXPECT_EQ(s.cases[2].factors.numbers[1][0].base, 900);
}

TEST(FactorsOfWhatIf, AreNotWhatItSets) {
  // A draw that is the number itself would undo the what-if; one that multiplies it starts from there.
  const auto tables = [](const char* how, const char* set) {
    return std::string("[vary]\n\"spring.stiffness\" = { lognormal = 1, sd = 0.2") + how +
           " }\n\"spring.from.*\" = { normal = 0, sd = 0.1 }\n[what_if.other]\nset = \"" + set + "\"\n";
  };
  std::string said = factor_refusals(tables("", "spring.stiffness=x0.5"));
  EXPECT_TRUE(test::contains(said, ":7:10: what_if.other.set: sets spring.stiffness, and [vary] gives another value"))
      << said;
  said = factor_refusals(tables(", relative = true", "*.from.y=2"));
  EXPECT_TRUE(test::contains(said, "sets spring.from.y, and [vary]")) << said;
  const test::TemporaryFolder folder;
  for (const char* set : {"spring.stiffness=x0.5", "spring.to.x=1"})
    test::ready_sweep(test::ball_study(folder, "samples = 4\n", tables(", relative = true", set)));
}

}  // namespace
}  // namespace genu
