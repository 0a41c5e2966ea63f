#include "genu/sweep/write_sample.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "genu/study/run_scene.h"
#include "genu/sweep/solve_sample.h"
#include "support/judged.h"
#include "support/meshed_ball.h"
#include "support/text.h"
#include "sweep/ball.h"

namespace genu {
namespace {

TEST(WriteSample, GivesItsMeshesToANormalRunWithTheSameBits) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "deep");
  const Sweep s = test::ready_sweep(test::meshed_ball_study(folder, "samples = 5\ntables = \"all\"\n"));
  const auto sample = solve_sample(s, s.cases[0], 3, {});
  ASSERT_TRUE(sample && sample->table) << sample->reason;
  for (const std::string& target : {folder / "one", folder / "deep/one"}) {
    Diagnostics out;
    const auto source = write_sample(s, s.cases[0], 3, target, out);
    ASSERT_TRUE(source) << test::messages(out);
    EXPECT_EQ(source->path, target + ".scene/scene.toml");
    ASSERT_EQ(run_scene(*source, target, {}, out, nullptr), kExitOk) << test::messages(out);
    EXPECT_EQ(test::read_file(target + "/results.csv"), sample->table->to_csv());
    ASSERT_TRUE(write_sample(s, s.cases[0], 4, target, out)) << "replaces its own files";
  }
  Diagnostics out;
  std::filesystem::create_directory(folder / "full.scene");
  folder.write("full.scene/mine.txt", "");
  EXPECT_FALSE(write_sample(s, s.cases[0], 3, folder / "full", out));
  EXPECT_TRUE(out.has_errors());
}

TEST(WriteSample, WritesNothingWhereOptionsSayAll) {
  const test::TemporaryFolder folder;
  const Sweep s = test::ready_sweep(test::ball_study(folder, "samples = 5\n", test::kBallVary));
  Diagnostics out;
  const auto source = write_sample(s, s.cases[0], 3, folder / "one", out);
  ASSERT_TRUE(source);
  EXPECT_EQ(source->path, s.cases[0].source.path);
  EXPECT_EQ(source->changes, source_of_sample(s, s.cases[0], 3).changes);
  EXPECT_FALSE(std::filesystem::exists(folder / "one.scene"));
}

}  // namespace
}  // namespace genu
