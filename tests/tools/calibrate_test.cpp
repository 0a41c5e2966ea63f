// genu calibrate, run as a user runs it.
#include <filesystem>

#include <gtest/gtest.h>

#include "support/leskovar.h"
#include "tools/cli_scenes.h"

namespace genu::test {
namespace {

TEST(CliCalibrate, FitsTheExample) {
  const TemporaryFolder folder;
  const Outcome o = genu("calibrate " + kLeskovar + "calibration.toml --target " + kLeskovar +
                         "calibration-target.csv --vary \"j1.stiffness,j1.damping\" --columns j1.angle_deg --out " +
                         (folder / "out"));
  EXPECT_EQ(o.exit_code, 0) << o.out << o.err;
  for (const char* piece : {"j1.stiffness", "0.5535", "converged", "rms", "scene.toml"})
    EXPECT_NE(o.out.find(piece), std::string::npos) << piece << "\n" << o.out;
  EXPECT_TRUE(std::filesystem::exists(folder / "out/scene.toml"));
  EXPECT_EQ(genu("check " + (folder / "out/scene.toml")).exit_code, 0);
}

TEST(CliCalibrate, RefusesWithEveryErrorAtOnce) {
  const TemporaryFolder folder;
  const std::string target = folder.write("t.csv", "time_s,j1.angle\n0,1\n");
  const Outcome o = genu("calibrate " + kLeskovar + "calibration.toml --target " + target +
                         " --vary j9.stiffness --out " + (folder / "out"));
  EXPECT_EQ(o.exit_code, 2);
  EXPECT_NE(o.err.find("--vary = \"j9.stiffness\": is no parameter of this scene"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("t.csv:1:8: j1.angle: is no column"), std::string::npos) << o.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  EXPECT_EQ(genu("calibrate " + kLeskovar + "calibration.toml --vary j1.stiffness").exit_code, 2) << "no target";
}

}  // namespace
}  // namespace genu::test
