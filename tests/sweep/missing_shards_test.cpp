#include "genu/sweep/missing_shards.h"

#include <gtest/gtest.h>

#include "support/text.h"
#include "sweep/ball.h"

namespace genu {
namespace {

TEST(MissingShards, AreThoseThatAreNotThereOrNotWhole) {
  const test::TemporaryFolder folder;
  const Sweep s = test::ready_sweep(test::ball_study(folder, "samples = 46\n", test::kBallVary));
  for (const std::uint64_t k : {1u, 2u, 6u}) test::ran(s, folder / "o", {k, 9});
  Diagnostics out;
  const auto record = read_record(folder / "o", out);
  ASSERT_TRUE(record);
  EXPECT_EQ(as_array_list(missing_shards(folder / "o", *record, out)), "3-5,7-9");
  EXPECT_TRUE(out.items().empty());
  const std::string path = shard_path(folder / "o", {2, 9}), whole = test::read_file(path);
  folder.write("o/shard-2-of-9.csv", whole.substr(0, whole.size() / 2));
  EXPECT_EQ(as_array_list(missing_shards(folder / "o", *record, out)), "2-5,7-9");
  EXPECT_TRUE(test::contains(test::messages(out), "shard-2-of-9.csv: warning: is cut short")) << test::messages(out);
  Diagnostics merging;
  std::string text;
  EXPECT_EQ(merge_sweep(folder / "o", merging, text), kExitRefused);
  EXPECT_TRUE(test::contains(test::messages(merging), "lacks 6 of 9 shards: 3-5,7-9")) << test::messages(merging);
  Diagnostics again;
  SweepOptions options;
  options.shard = {2, 9};
  SweepOutcome outcome;
  EXPECT_EQ(run_shard(s, folder / "o", options, again, outcome), kExitOk);
  EXPECT_TRUE(test::contains(test::messages(again), "shard-2-of-9.csv: warning: is cut short: it is computed again"));
  EXPECT_EQ(outcome.earlier, 0u);
  EXPECT_EQ(test::read_file(path), whole);
}

}  // namespace
}  // namespace genu
