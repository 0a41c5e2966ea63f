// genu sweep, run as a user runs it.
#include <filesystem>

#include <gtest/gtest.h>

#include "tools/cli_scenes.h"

namespace genu::test {
namespace {

const std::string kStudy = R"(format = 1
scene = "ball.toml"
samples = 30
design = "sobol"
[vary]
"*.stiffness" = { lognormal = 1, sd = 0.2, relative = true }
[what_if.loose]
set = "far.stiffness=x0.5"
[[keep]]
columns = ["knee.y", "medial.gap"]
at = "all"
)";

/// The study of the ball on a plate in a folder.
std::string study_in(const TemporaryFolder& folder) {
  folder.write("ball.toml", kBall);
  return folder.write("study.toml", kStudy);
}

TEST(CliSweep, RunsAStudyAndItsShards) {
  const TemporaryFolder folder;
  const std::string study = study_in(folder);
  const Outcome whole = genu("sweep " + study + " --out " + (folder / "whole"));
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_TRUE(contains(whole.out, "60 runs, ")) << whole.out;
  EXPECT_TRUE(contains(whole.out, "loose - as_is")) << whole.out;
  EXPECT_EQ(genu("sweep " + study + " --out " + (folder / "parts") + " --plan 3").exit_code, 0);
  const Outcome all = genu("sweep missing " + (folder / "parts"));
  EXPECT_EQ(all.exit_code, 3);
  EXPECT_EQ(all.out, "1-3\n");
  EXPECT_EQ(genu("sweep " + study + " --out " + (folder / "parts") + " --shard 2/3 --threads 1").exit_code, 0);
  EXPECT_EQ(genu("sweep missing " + (folder / "parts")).out, "1,3\n");
  EXPECT_EQ(genu("sweep merge " + (folder / "parts")).exit_code, 2);
  for (const char* k : {"1", "3", "3"})
    EXPECT_EQ(genu("sweep " + study + " --out " + (folder / "parts") + " --shard " + k + "/3").exit_code, 0);
  EXPECT_EQ(genu("sweep missing " + (folder / "parts")).exit_code, 0);
  EXPECT_EQ(genu("sweep merge " + (folder / "parts")).exit_code, 0);
  for (const char* file : {"samples.csv", "statistics.csv", "summary.json", "report.html"})
    EXPECT_EQ(read_file(folder / "whole/" + file), read_file(folder / "parts/" + file)) << file;
}

TEST(CliSweep, ContinuesAfterAKill) {
  const TemporaryFolder folder;
  const std::string study = source_folder() + "/meshes/dortmans1984/sweep.toml";
  const std::string own = folder.write(
      "study.toml",
      with_first(with_first(read_file(study), "scene.toml", source_folder() + "/meshes/dortmans1984/scene.toml"),
                 "samples = 100", "samples = 2000"));
  const std::string command = program() + " sweep " + own + " --quiet --out ";
  shell("timeout -s KILL 1.5 " + command + (folder / "killed") + " --threads 1");
  ASSERT_FALSE(std::filesystem::exists(folder / "killed/shard-1-of-1.csv"));
  shell("timeout -s INT 1.5 " + command + (folder / "killed") + " --threads 1");
  const Outcome rest = shell(command + (folder / "killed"));
  EXPECT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_TRUE(contains(rest.out, "of an earlier start")) << rest.out;
  EXPECT_EQ(shell(command + (folder / "whole")).exit_code, 0);
  EXPECT_EQ(read_file(folder / "killed/samples.csv"), read_file(folder / "whole/samples.csv"));
}

TEST(CliSweep, SubmitsAnArrayThatABatchSystemCanRun) {
  const TemporaryFolder folder;
  const std::string study = study_in(folder);
  genu("sweep " + study + " --out " + (folder / "o") + " --plan 2");
  // A Slurm of one line: each task of the array in turn.
  std::filesystem::create_directory(folder / "bin");
  folder.write("bin/sbatch",
               "#!/bin/sh\nfor k in $(sed -n 's/#SBATCH --array=//p' \"$1\" | tr , ' ' | tr - ' '); do\n"
               "  SLURM_ARRAY_TASK_ID=$k sh \"$1\" || exit 1\ndone\n");
  std::filesystem::permissions(folder / "bin/sbatch", std::filesystem::perms::owner_all);
  const Outcome submitted = shell("PATH=" + (folder / "bin") + ":$PATH " + program() + " sweep submit " +
                                  (folder / "o") + " --slurm --time 0:10:00 --cores 1");
  EXPECT_EQ(submitted.exit_code, 0) << submitted.out << submitted.err;
  EXPECT_EQ(genu("sweep merge " + (folder / "o")).exit_code, 0);
  EXPECT_EQ(genu("sweep " + study + " --out " + (folder / "whole")).exit_code, 0);
  EXPECT_EQ(read_file(folder / "o/samples.csv"), read_file(folder / "whole/samples.csv"));
  EXPECT_TRUE(contains(genu("sweep submit " + (folder / "o")).out, "Nothing is missing"));
  const std::string shard = read_file(folder / "o/shard-2-of-2.csv");
  folder.write("o/shard-2-of-2.csv", shard.substr(0, shard.size() / 2));
  const Outcome broken = shell("PATH=" + (folder / "bin") + ":$PATH " + program() + " sweep submit " + (folder / "o") +
                               " --slurm --cores 1");
  EXPECT_EQ(broken.exit_code, 0) << broken.out << broken.err;
  EXPECT_EQ(occurrences(broken.err, "shard-2-of-2.csv: warning: is cut short\n"), 1) << broken.err;
  EXPECT_EQ(read_file(folder / "o/shard-2-of-2.csv"), shard);
  for (const char* file : {"sweep.condor", "sweep.parallel"})
    EXPECT_TRUE(std::filesystem::exists(folder / "o/" + file));
}

TEST(CliSweep, RunsOneSampleThatTheJudgeAccepts) {
  const TemporaryFolder folder;
  const std::string study = study_in(folder);
  ASSERT_EQ(genu("sweep " + study + " --out " + (folder / "all") + " --quiet").exit_code, 0);
  const Outcome one = genu("sweep " + study + " --sample 17 --case ball/loose --out " + (folder / "one"));
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(genu("judge " + (folder / "one")).exit_code, 0);
  EXPECT_EQ(genu("sweep " + study + " --sample 30 --out " + (folder / "two")).exit_code, 2);
  const Outcome other = genu("sweep " + study + " --sample 1 --case ball/lose --out " + (folder / "two"));
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_TRUE(contains(other.err, "the cases of this study are ball/as_is, ball/loose")) << other.err;
}

TEST(CliSweep, RefusesWhatMakesNoStudy) {
  const TemporaryFolder folder;
  const std::string study = study_in(folder);
  EXPECT_EQ(genu("sweep " + study).exit_code, 2) << "no folder";
  EXPECT_EQ(genu("sweep " + study + " --out " + (folder / "o") + " --shard 3/2").exit_code, 2);
  EXPECT_EQ(genu("sweep merge").exit_code, 2);
  EXPECT_EQ(genu("sweep missing " + (folder / "nothing")).exit_code, 2);
  EXPECT_EQ(genu("sweep " + (folder / "ball.toml") + " --out " + (folder / "o")).exit_code, 2) << "a scene";
  folder.write("study.toml", with_first(kStudy, "\"*.stiffness\"", "\"*.stifness\""));
  const Outcome o = genu("sweep " + study + " --out " + (folder / "o"));
  EXPECT_EQ(o.exit_code, 2);
  EXPECT_TRUE(contains(o.err, "study.toml:6:1: vary.*.stifness")) << o.err;
  folder.write("study.toml", with_first(kStudy, "samples = 30", "samples = -1"));
  EXPECT_TRUE(contains(genu("sweep " + study + " --out " + (folder / "o")).err, "`genu explain sweep` lists the keys"));
  EXPECT_FALSE(std::filesystem::exists(folder / "o"));
}

}  // namespace
}  // namespace genu::test
