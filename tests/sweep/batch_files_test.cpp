#include "genu/sweep/batch_files.h"

#include <gtest/gtest.h>

#include "support/text.h"

namespace genu {
namespace {

TEST(BatchFiles, AskForTheMissingShards) {
  SweepRecord record;
  record.study = "/home/me/my study.toml";
  record.shards = 40;
  BatchOptions options;
  options.program = "/usr/bin/genu";
  options.nodes = 4;
  options.cores = 8;
  const auto files = batch_files(record, "/data/out", {3, 17, 18, 19}, options);
  ASSERT_EQ(files.size(), 3u);
  const std::string command =
      std::string("exec /usr/bin/genu sweep '/home/me/my study.toml' --out /data/out --shard ") +
      "\"$SLURM_ARRAY_TASK_ID\"/40 --threads 8\n";
  EXPECT_TRUE(test::contains(files[0].second, command)) << files[0].second;
  for (const char* line :
       {"#SBATCH --array=3,17-19%4\n", "#SBATCH --requeue\n", "#SBATCH --cpus-per-task=8\n", "#SBATCH --time=1:00:00\n",
        "#SBATCH --signal=B:TERM@30\n"})  // to genu, which is the batch process: there is no job step
    EXPECT_TRUE(test::contains(files[0].second, line)) << files[0].second;
  EXPECT_TRUE(test::contains(files[1].second, "queue shard from (\n  3\n  17\n  18\n  19\n)")) << files[1].second;
  EXPECT_TRUE(test::contains(files[2].second, "--shard {}/40 --threads 8 ::: 3 17 18 19\n")) << files[2].second;
}

TEST(BatchFiles, GiveHTCondorWordsWithBlanksAndQuotes) {
  SweepRecord record;
  record.study = "/home/me/my \"best\" study.toml";
  BatchOptions options;
  options.program = "/opt/my genu/genu";
  const std::string text = batch_files(record, "/data/Anna's $(x)", {1}, options)[1].second;
  const std::string words =
      "\"sweep '/home/me/my \"\"best\"\" study.toml' --out '/data/Anna''s $(DOLLAR)(x)' --shard $(shard)/1 --threads "
      "1\"\n";
  EXPECT_TRUE(test::contains(text, "arguments = " + words)) << text;
  for (const char* line :
       {"executable = /opt/my genu/genu\n", "request_cpus = 1\n", "log = /data/Anna's $(DOLLAR)(x)/condor.log\n"})
    EXPECT_TRUE(test::contains(text, line)) << text;
}

}  // namespace
}  // namespace genu
