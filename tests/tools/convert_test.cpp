// genu convert, run as a user runs it.
#include <filesystem>

#include <gtest/gtest.h>

#include "tools/cli_scenes.h"

namespace genu::test {
namespace {

TEST(CliConvert, WritesForParaViewAndOpenSim) {
  TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", kBall), run = folder / "run";
  ASSERT_EQ(genu("run " + scene + " --quiet --out " + run).exit_code, 0);
  const Outcome vtk = genu("convert " + run + " --to vtk --out " + (folder / "vtk"));
  EXPECT_EQ(vtk.exit_code, 0) << vtk.err;
  EXPECT_TRUE(contains(vtk.out, "poses.pvd: for ParaView, 21 files")) << vtk.out;
  EXPECT_TRUE(contains(vtk.out, "6 rows; time is time_s")) << vtk.out;
  const Outcome mot = genu("convert " + run + " --side r --quiet --out " + (folder / "ball.mot"));
  EXPECT_EQ(mot.exit_code, 0) << mot.err;
  EXPECT_EQ(mot.out, "");
  EXPECT_TRUE(contains(read_file(folder / "ball.mot"), "\ntime\tknee_flex_r\tknee_add_r\t"));
  EXPECT_EQ(genu("convert " + run + " --to opensim --out " + (folder / "osim")).exit_code, 0);
  EXPECT_EQ(read_file(folder / "osim/motion.mot").substr(0, 11), "Coordinates");
  // Poses that were given have results too.
  ASSERT_EQ(genu("evaluate " + scene + " --poses " + (folder / "ball.mot") + " --out " + (folder / "given")).exit_code,
            0);
  EXPECT_EQ(genu("convert " + (folder / "given") + " --out " + (folder / "given.sto")).exit_code, 0);
}

TEST(CliConvert, RefusesWhatItCannotReadOrMustNotReplace) {
  TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", kBall), run = folder / "run";
  ASSERT_EQ(genu("run " + scene + " --quiet --out " + run).exit_code, 0);
  const auto refused = [&](const std::string& arguments, const std::string& said) {
    const Outcome outcome = genu("convert " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments << outcome.out;
    EXPECT_TRUE(contains(outcome.err, said)) << arguments << "\n" << outcome.err;
  };
  const std::string out = " --out " + (folder / "x");
  refused((folder / "none") + " --to vtk" + out, "results.csv: is not there");
  refused(run + out, "give --to vtk or --to opensim");
  refused(run + " --to stl" + out, "--to: stl not in {vtk,opensim}");
  refused(run + " --to opensim --side right" + out, "--side: right not in {r,l}");
  refused(run + " --to vtk --out " + (folder / "x.mot"), "writes a folder");
  refused(run + " --out " + (folder / "x.pvd"), "--to vtk --out FOLDER");
  refused(run + " --to vtk --out " + run, "which would be lost");
  refused(run + " --to vtk --out " + (folder / ""), "which would be lost");
  refused(run + " --to vtk --every 0" + out, "--every");
  refused(run + " --to vtk --time nothing" + out, "is no column of the results");
  std::filesystem::remove(scene);
  refused(run + " --to vtk" + out, "ball.toml");
  EXPECT_FALSE(std::filesystem::exists(folder / "x"));
}

}  // namespace
}  // namespace genu::test
