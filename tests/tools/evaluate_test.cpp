// genu evaluate, run as a user runs it.
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tools/cli_scenes.h"

namespace genu::test {
namespace {

const std::string kStorage =
    "Coordinates\nversion=1\nnRows=2\nnColumns=8\ninDegrees=yes\nendheader\n"
    "time\t/jointset/knee_r/knee_flex_r/value\t/jointset/knee_r/knee_flex_r/speed\tknee_add_r\tknee_rot_r\tknee_tx_r\t"
    "knee_ty_r\tknee_tz_r\n"
    "0\t0\t9\t0\t0\t0\t0\t0.025\n"
    "0.5\t10\t9\t0\t0\t0\t0\t0.019\n";

TEST(CliEvaluate, ReadsWhatOpenSimWrites) {
  TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", kBall), poses = folder.write("follow.mot", kStorage);
  const Outcome good = genu("evaluate " + scene + " --poses " + poses + " --out " + (folder / "out"));
  EXPECT_EQ(good.exit_code, 0) << good.err;
  EXPECT_TRUE(contains(good.out, "knee.flexion  deg")) << good.out;
  EXPECT_TRUE(contains(good.out, "OpenSim's habit, unit: inDegrees=yes")) << good.out;
  EXPECT_TRUE(contains(good.out, "ignored: 1 other column (/jointset/knee_r/knee_flex_r/speed)")) << good.out;
  EXPECT_TRUE(contains(good.out, "2 poses evaluated, none solved")) << good.out;
  EXPECT_TRUE(contains(good.out, "overlap by up to 1 mm")) << good.out;
  for (const char* file : {"results.csv", "curves.svg", "summary.json"})
    EXPECT_TRUE(std::filesystem::file_size(folder / (std::string("out/") + file)) > 0) << file;
  EXPECT_TRUE(contains(read_file(folder / "out/results.csv"), "\n1,1,0.5,ok,10,0,0,0,0,19,"));
  const Outcome metres =
      genu("evaluate " + scene + " --poses " + poses + " --units rad --quiet --out " + (folder / "out"));
  EXPECT_EQ(metres.exit_code, 0) << metres.err;
  EXPECT_EQ(metres.out, "");
  EXPECT_TRUE(contains(read_file(folder / "out/results.csv"), "\n1,1,0.5,ok,572.95")) << "the folder is replaced";
}

TEST(CliEvaluate, ReadsMatrices) {
  TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", kBall);
  // A quarter turn about x, which is the flexion's axis, and a shift by 1, 2, 19 mm.
  const std::string row = "1,0,0,1,0,0,-1,2,0,1,0,19,0,0,0,1\n", out = " --out " + (folder / "out");
  const std::string poses = folder.write("poses.csv", "0.1," + row + "0.2," + row);
  const Outcome good = genu("evaluate " + scene + " --poses " + poses + " --transforms 'knee=2-17[mm]'" + out);
  EXPECT_EQ(good.exit_code, 0) << good.err;
  EXPECT_TRUE(contains(good.out, "2 ... 17") && contains(good.out, "--transforms")) << good.out;
  EXPECT_TRUE(contains(read_file(folder / "out/results.csv"), "ok,90,0,0,1,2,19,"))
      << read_file(folder / "out/results.csv");
  const std::string bad = folder.write("bad.csv", "0.1," + row + "0.2," + with_first(row, "1,0,0,1", "3,0,0,1"));
  const Outcome refused = genu("evaluate " + scene + " --poses " + bad + " --transforms 'knee=2-17[mm]'" + out);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(contains(refused.err, "bad.csv:2:5: transform of knee in row 2: is no rotation")) << refused.err;
}

TEST(CliEvaluate, RefusesAndLeavesTheEarlierResult) {
  TemporaryFolder folder;
  const std::string scene = folder.write("ball.toml", kBall), poses = folder.write("follow.mot", kStorage);
  const std::string ask = "evaluate " + scene + " --out " + (folder / "out") + " --poses ";
  ASSERT_EQ(genu(ask + poses).exit_code, 0);
  const std::string before = read_file(folder / "out/results.csv");
  const auto refused = [&](const std::string& arguments, const std::string& said) {
    const Outcome outcome = genu(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments << "\n" << outcome.out;
    EXPECT_TRUE(contains(outcome.err, said)) << arguments << "\n" << outcome.err;
    EXPECT_EQ(read_file(folder / "out/results.csv"), before);
  };
  refused(ask + (folder / "none.csv"), "none.csv: there is no such file");
  refused(ask + folder.write("bad.mot", with_first(kStorage, "0.019", "0.0l9")), "bad.mot:9:");
  refused(ask + folder.write("few.csv", "knee.flexion\n1\n"), "no column gives \"knee.adduction\"");
  refused(ask + poses + " --columns 'knee.flexoin=time'", "did you mean \"knee.flexion\"?");
  refused(ask + poses + " --units inch", "--units");
  refused("evaluate " + (folder / "no.toml") + " --poses " + poses + " --out " + (folder / "out"), "no.toml");
  refused("evaluate " + scene + " --poses " + poses, "--out is required");
  refused("evaluate " + scene + " --out " + (folder / "out"), "--poses is required");
  refused("evaluate " + scene + " --poses " + poses + " --out " + (folder / ""), "");
}

}  // namespace
}  // namespace genu::test
