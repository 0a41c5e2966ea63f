#include "genu/sweep/run_sweep.h"
#include "genu/core/program_hash.h"

#include <atomic>
#include <filesystem>
#include <thread>

#include <gtest/gtest.h>

#include "genu/core/file_checksum.h"
#include "genu/sweep/finished_rows.h"
#include "support/meshed_ball.h"
#include "support/text.h"
#include "sweep/ball.h"

namespace genu {
namespace {

const std::vector<std::string> kMerged = {"samples.csv", "samples.npz",     "statistics.csv", "events.csv",
                                          "ranks.csv",   "convergence.csv", "summary.json",   "report.html"};

std::string study_of(const test::TemporaryFolder& folder, const std::string& head = "samples = 23\n") {
  return test::ball_study(folder, head, test::kBallVary + "[what_if.heavy]\nset = \"pull.force.y=1\"\n");
}

std::string refused(const Sweep& sweep, const std::string& folder, ShardId shard = {}) {
  SweepOptions options;
  options.shard = shard;
  Diagnostics out;
  SweepOutcome outcome;
  EXPECT_EQ(run_shard(sweep, folder, options, out, outcome), kExitRefused);
  return test::messages(out);
}

TEST(RunShard, GivesTheSameBytesForAnyThreadsAndShards) {
  const test::TemporaryFolder folder;
  const Sweep s = test::ready_sweep(study_of(folder));
  EXPECT_EQ(test::ran(s, folder / "one", {}, 1).runs, 46u);
  test::merge(folder / "one");
  for (const std::uint64_t count : {1u, 7u, 64u}) {
    const std::string other = folder / ("n" + std::to_string(count));
    for (std::uint64_t k = count; k > 0; --k) test::ran(s, other, {k, count}, 2);
    test::merge(other);
    for (const std::string& file : kMerged)
      EXPECT_EQ(test::read_file(folder / ("one/" + file)), test::read_file(other + "/" + file)) << file << count;
  }
}

TEST(RunShard, GivesTheSameBytesWhereMeshesErr) {
  const test::TemporaryFolder folder;
  const Sweep s = test::ready_sweep(test::meshed_ball_study(folder, "samples = 9\ntables = [3, \"not_solved\"]\n"));
  test::ran(s, folder / "one", {}, 1);
  test::merge(folder / "one");
  for (const std::uint64_t count : {1u, 4u}) {
    const std::string other = folder / ("n" + std::to_string(count));
    for (std::uint64_t k = count; k > 0; --k) test::ran(s, other, {k, count}, 2);
    test::merge(other);
    for (const std::string& file : kMerged)
      EXPECT_EQ(test::read_file(folder / ("one/" + file)), test::read_file(other + "/" + file)) << file << count;
    EXPECT_EQ(test::read_file(folder / "one/tables.csv"), test::read_file(other + "/tables.csv"));
  }
  // What names a random field is no amount: it has no rank.
  const std::string ranks = test::read_file(folder / "one/ranks.csv");
  EXPECT_TRUE(test::contains(ranks, "ball,as_is,j.z_mm@0,skin.mesh_error,9,,,\n")) << ranks;
}

TEST(RunShard, ContinuesWithWhatIsFinished) {
  const test::TemporaryFolder folder;
  const Sweep s = test::ready_sweep(study_of(folder));
  test::ran(s, folder / "whole");
  std::atomic<int> done = 0;
  SweepOptions options;
  options.threads = 1;
  options.progress = [&](int n, int) { done = n; };
  options.cancelled = [&] { return done >= 10; };
  Diagnostics out;
  SweepOutcome stopped;
  EXPECT_EQ(run_shard(s, folder / "part", options, out, stopped), kExitIncomplete);
  EXPECT_TRUE(stopped.interrupted);
  EXPECT_FALSE(std::filesystem::exists(folder / "part/shard-1-of-1.csv"));
  // A kill in the middle of a write leaves half a line.
  const std::string kept = test::read_file(folder / "part/shard-1-of-1.csv.part");
  folder.write("part/shard-1-of-1.csv.part", kept.substr(0, kept.size() - 20));
  const SweepOutcome rest = test::ran(s, folder / "part");
  EXPECT_EQ(rest.earlier, 9u);
  EXPECT_EQ(test::read_file(folder / "part/shard-1-of-1.csv"), test::read_file(folder / "whole/shard-1-of-1.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder / "part/shard-1-of-1.csv.part"));
  EXPECT_EQ(test::ran(s, folder / "part").earlier, 46u);  // it is there: nothing is computed
}

TEST(RunShard, ContinuesRowsOfItsOwnBuildAlone) {
  const test::TemporaryFolder folder;
  const Sweep s = test::ready_sweep(study_of(folder));
  for (const bool own : {false, true}) {
    const std::string out = folder / (own ? "own" : "other");
    test::ran(s, out, {1, 2});  // makes the folder
    const std::string row = own ? " " + program_hash() : " another build";
    FinishedRows(shard_path(out, {2, 2}) + ".part", s.hash + " 2/2" + row).add(30, "30,ball,heavy,solved,0,,1,2,3,,,");
    EXPECT_EQ(test::ran(s, out, {2, 2}).earlier, own ? 1u : 0u);
  }
}

TEST(RunShard, RefusesAChangedStudyAndOtherShards) {
  const test::TemporaryFolder folder;
  test::ran(test::ready_sweep(study_of(folder)), folder / "o", {1, 2});
  EXPECT_TRUE(
      test::contains(refused(test::ready_sweep(study_of(folder)), folder / "o", {1, 3}), "is divided into 2 shards"));
  const Sweep other = test::ready_sweep(study_of(folder, "samples = 24\n"));
  EXPECT_TRUE(test::contains(refused(other, folder / "o", {2, 2}), "belongs to another study"));
  const Sweep scene = test::ready_sweep(study_of(folder));
  folder.write("ball.toml", test::kBallOnSpring + "# changed\n");
  const Sweep changed = test::ready_sweep(folder / "study.toml");
  EXPECT_NE(scene.hash, changed.hash);
  EXPECT_TRUE(test::contains(refused(changed, folder / "o", {2, 2}), "has changed since"));
  folder.write("mine.txt", "");
  EXPECT_TRUE(test::contains(refused(scene, folder / ".", {}), "holds other things than a sweep"));
}

TEST(RunShard, StartsBesideAnotherThatMakesTheFolder) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "o");
  folder.write("o/.sweep.json.host-17", "{");  // half written by another process
  EXPECT_EQ(test::ran(test::ready_sweep(study_of(folder)), folder / "o").runs, 46u);
}

TEST(RunShard, LeavesAShardToTheProcessThatComputesIt) {
  const test::TemporaryFolder folder;
  const Sweep s = test::ready_sweep(study_of(folder));
  test::ran(s, folder / "o", {1, 2});  // makes the folder
  const FinishedRows other(shard_path(folder / "o", {2, 2}) + ".part", "other");
  SweepOptions options;
  options.shard = {2, 2};
  int solved = 0;
  options.progress = [&](int, int) { ++solved; };
  Diagnostics out;
  SweepOutcome outcome;
  EXPECT_EQ(run_shard(s, folder / "o", options, out, outcome), kExitFailed);
  EXPECT_EQ(solved, 0);
  EXPECT_TRUE(test::contains(test::messages(out), "another process computes this shard: wait for it"))
      << test::messages(out);
}

TEST(ClaimFolder, IsOfOneStudyAlone) {
  const test::TemporaryFolder folder;
  for (int time = 0; time < 20; ++time) {
    std::vector<std::thread> all;
    std::atomic<int> claims = 0;
    for (int k = 0; k < 8; ++k)
      all.emplace_back([&, k] {
        SweepRecord record;
        record.hash = "study " + std::to_string(k);
        Diagnostics out;
        claims += claim_folder(folder / ("o" + std::to_string(time)), record, out) ? 1 : 0;
      });
    for (std::thread& one : all) one.join();
    EXPECT_EQ(claims, 1);
  }
}

TEST(MergeSweep, SaysThatShardsAreOfDifferentPrograms) {
  const test::TemporaryFolder folder;
  const Sweep s = test::ready_sweep(study_of(folder));
  test::ran(s, folder / "o", {1, 2});
  test::ran(s, folder / "o", {2, 2});
  const auto warnings = [&] {
    Diagnostics out;
    std::string text;
    EXPECT_EQ(merge_sweep(folder / "o", out, text), kExitOk);
    return test::messages(out);
  };
  EXPECT_EQ(warnings(), "");
  const std::string samples = test::read_file(folder / "o/samples.csv");
  // The file as another build writes it.
  std::string text = test::read_file(shard_path(folder / "o", {2, 2}));
  text = test::with_first(text.substr(0, text.rfind("# end ")), program_hash(), "another");
  folder.write("o/shard-2-of-2.csv", text + "# end 23 " + checksum(text).xxh128 + "\n");
  EXPECT_TRUE(test::contains(warnings(), "has shards of different builds of genu")) << warnings();
  EXPECT_EQ(test::read_file(folder / "o/samples.csv"), samples);
}

TEST(MergeSweep, RefusesAShardThatWasChanged) {
  const test::TemporaryFolder folder;
  const Sweep s = test::ready_sweep(study_of(folder));
  test::ran(s, folder / "o");
  const std::string path = shard_path(folder / "o", {});
  folder.write("o/shard-1-of-1.csv", test::with_first(test::read_file(path), "solved", "sOlved"));
  Diagnostics out;
  std::string text;
  EXPECT_EQ(merge_sweep(folder / "o", out, text), kExitRefused);
  EXPECT_TRUE(test::contains(test::messages(out), "shard-1-of-1.csv: has changed since it was written"));
}

TEST(PrepareSweep, NamesScenesAlikeFromEveryFolder) {
  const test::TemporaryFolder folder;
  for (const char* subject : {"a", "b"}) {
    std::filesystem::create_directory(folder / subject);
    folder.write(std::string(subject) + "/scene.toml", test::kBallOnSpring);
  }
  const std::string study =
      folder.write("cohort.toml", "format = 1\nscenes = [\"a/scene.toml\", \"b/scene.toml\"]\nsamples = 2\n" +
                                      test::kBallVary + "[[keep]]\ncolumns = \"j.z\"\nat = \"last\"\n");
  const std::string relative = std::filesystem::proximate(study).string();
  ASSERT_NE(relative, study);
  const Sweep here = test::ready_sweep(relative), there = test::ready_sweep(study);
  ASSERT_EQ(there.cases.size(), 2u);
  EXPECT_EQ(there.cases[1].scene, "b/scene.toml");
  EXPECT_EQ(here.cases[1].scene, "b/scene.toml");
  // Shards of both merge, and rows of other cases do not.
  test::ran(here, folder / "o", {1, 2});
  test::ran(there, folder / "o", {2, 2});
  test::merge(folder / "o");
  folder.write("o/sweep.json", test::with_first(test::read_file(folder / "o/sweep.json"), "b/scene.toml", "c"));
  Diagnostics out;
  std::string text;
  EXPECT_EQ(merge_sweep(folder / "o", out, text), kExitRefused);
  EXPECT_TRUE(test::contains(test::messages(out), "has a row 1 that is none of this sweep")) << test::messages(out);
}

TEST(PrepareSweep, NamesEveryBrokenSceneOfACohort) {
  const test::TemporaryFolder folder;
  test::ball_study(folder, "", "");
  folder.write("a.toml", test::with_first(test::kBallOnSpring, "stiffness = 1000", "stiffness = -1"));
  folder.write("b.toml", test::with_first(test::kBallOnSpring, "body = \"ball\"\nforce", "body = \"bal\"\nforce"));
  const std::string study = folder.write("cohort.toml",
                                         "format = 1\nscenes = [\"a.toml\", \"ball.toml\", \"b.toml\"]\n"
                                         "samples = 2\n" +
                                             test::kBallVary + "[[keep]]\ncolumns = \"j.z\"\nat = \"last\"\n");
  Diagnostics out;
  EXPECT_FALSE(prepare_sweep(study, out));
  const std::string said = test::messages(out);
  EXPECT_TRUE(test::contains(said, "a.toml:18:")) << said;
  EXPECT_TRUE(test::contains(said, "b.toml:21:")) << said;
}

}  // namespace
}  // namespace genu
