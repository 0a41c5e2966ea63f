#include "genu/sweep/table_file.h"

#include <atomic>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "genu/study/run_scene.h"
#include "support/text.h"
#include "sweep/ball.h"

namespace genu {
namespace {

std::string study_with(const test::TemporaryFolder& folder, const std::string& tables,
                       const std::string& more = "[what_if.heavy]\nset = \"pull.force.y=1\"\n") {
  return test::ball_study(folder, "samples = 23\n" + tables, test::kBallVary + more);
}

std::string error_of(const std::string& study) {
  Diagnostics out;
  EXPECT_FALSE(prepare_sweep(study, out));
  return test::messages(out);
}

/// The rows of a run in tables.csv, without what tells whose they are, below the names of their columns.
std::string rows_of(const std::string& tables, const std::string& run) {
  std::stringstream lines(tables);
  std::string line, out;
  std::getline(lines, line);
  out = line.substr(std::string("sample,scene,what_if,").size()) + "\n";
  while (std::getline(lines, line))
    if (line.starts_with(run)) out += line.substr(run.size()) + "\n";
  return out;
}

TEST(WholeTables, AreThoseOfNormalRunsForAnyThreadsAndShards) {
  const test::TemporaryFolder folder;
  const Sweep s = test::ready_sweep(study_with(folder, "tables = \"all\"\n"));
  test::ran(s, folder / "one", {}, 1);
  test::merge(folder / "one");
  const std::string tables = test::read_file(folder / "one/tables.csv");
  EXPECT_EQ(test::occurrences(tables, "\n"), 1 + 46 * 3);
  for (const std::uint64_t count : {7u, 64u}) {
    const std::string other = folder / ("n" + std::to_string(count));
    for (std::uint64_t k = count; k > 0; --k) test::ran(s, other, {k, count}, 2);
    test::merge(other);
    EXPECT_EQ(test::read_file(other + "/tables.csv"), tables) << count;
  }
  for (const auto& [c, run] : {std::pair(0, "17,ball,as_is,"), std::pair(1, "5,ball,heavy,")}) {
    Diagnostics out;
    const std::string one = folder / ("sample" + std::to_string(c));
    ASSERT_EQ(run_scene(source_of_sample(s, s.cases[c], c == 0 ? 17 : 5), one, {}, out, nullptr), kExitOk);
    EXPECT_EQ(rows_of(tables, run), test::read_file(one + "/results.csv")) << run;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "one/shard-1-of-1.tables.part"));
}

TEST(WholeTables, AreKeptOfNamedSamplesClassesAndEvents) {
  const test::TemporaryFolder folder;
  const auto samples_of = [&](const std::string& tables) {
    const Sweep s = test::ready_sweep(
        study_with(folder, "tables = " + tables + "\n", "[event.far]\nwhen = \"j.z > 10.55\"\nat = \"last\"\n"));
    const std::string out = folder / ("o" + std::to_string(std::hash<std::string>()(tables)));
    test::ran(s, out);
    test::merge(out);
    std::stringstream lines(test::read_file(out + "/tables.csv"));
    std::string line, found;
    std::getline(lines, line);
    while (std::getline(lines, line))
      if (const std::string sample = line.substr(0, line.find(',')) + " ";
          !found.ends_with(" " + sample) && found != sample)
        found += sample;
    return found;
  };
  EXPECT_EQ(samples_of("[3, 11]"), "3 11 ");
  EXPECT_EQ(samples_of("5"), "5 ");
  EXPECT_EQ(samples_of("[\"not_solved\", \"jumped\"]"), "");
  EXPECT_EQ(test::occurrences(samples_of("\"solved\""), " "), 23);
  // Those of the event are the samples whose number is beyond the limit.
  const Sweep s = test::ready_sweep(study_with(folder, "", "[event.far]\nwhen = \"j.z > 10.55\"\nat = \"last\"\n"));
  std::string beyond;
  for (std::uint64_t k = 0; k < 23; ++k)
    if (solve_sample(s, s.cases[0], k, {})->kept.back() > 10.55) beyond += std::to_string(k) + " ";
  EXPECT_GT(test::occurrences(beyond, " "), 3);
  EXPECT_LT(test::occurrences(beyond, " "), 20);
  EXPECT_EQ(samples_of("\"far\""), beyond);
}

TEST(WholeTables, HaveTheColumnsOfAllScenes) {
  const test::TemporaryFolder folder;
  folder.write("a.toml", test::kBallOnSpring);
  folder.write("b.toml", test::with_first(test::kBallOnSpring, "[load.pull]",
                                          "[ligament.loose]\nfrom = { body = \"ground\", point = [0, 0, 0] }\n"
                                          "to = { body = \"ball\", point = [0, 0, 0] }\nlaw = \"linear\"\n"
                                          "stiffness = 1\nslack_length = 90\n[load.pull]"));
  const std::string study = folder.write(
      "study.toml",
      "format = 1\nscenes = [\"a.toml\", \"b.toml\"]\nsamples = 2\ntables = \"all\"\n[vary]\n\"spring.stiffness\" = "
      "{ uniform = [900, 1100] }\n[[keep]]\ncolumns = \"j.z\"\nat = \"last\"\n");
  const Sweep s = test::ready_sweep(study);
  test::ran(s, folder / "o", {1, 2});
  test::ran(s, folder / "o", {2, 2});
  test::merge(folder / "o");
  const std::string tables = test::read_file(folder / "o/tables.csv");
  Diagnostics out;
  ASSERT_EQ(run_scene(source_of_sample(s, s.cases[1], 1), folder / "b1", {}, out, nullptr), kExitOk);
  EXPECT_EQ(rows_of(tables, "1,b,as_is,"), test::read_file(folder / "b1/results.csv"));
  std::stringstream lines(tables);
  std::string head, row;
  std::getline(lines, head);
  std::getline(lines, row);
  const auto names = split_row(head), cells = split_row(row);
  ASSERT_EQ(names.size(), cells.size());
  for (std::size_t c = 0; c < names.size(); ++c)
    EXPECT_EQ(cells[c].empty(), names[c].starts_with("loose.")) << names[c];
  if (std::system("/usr/bin/python3 -c 'import numpy' 2>/dev/null") != 0) GTEST_SKIP() << "needs python3-numpy";
  const std::string script = folder.write("check.py", R"(
import sys, numpy as np
t = np.genfromtxt(sys.argv[1], delimiter=",", names=True, dtype=None, encoding=None, deletechars="")
assert len(t) == 12 and t["j.z_mm"].min() > 10, t
assert (t["scene"] == "b").sum() == 6 and np.isnan(t["loose.length_mm"]).sum() == 6
)");
  EXPECT_EQ(std::system(("/usr/bin/python3 " + script + " " + (folder / "o/tables.csv")).c_str()), 0);
}

TEST(WholeTables, OfAStoppedShardAreComputedOnce) {
  const test::TemporaryFolder folder;
  const Sweep s = test::ready_sweep(study_with(folder, "tables = \"all\"\n"));
  test::ran(s, folder / "whole");
  std::atomic<int> done = 0;
  SweepOptions options;
  options.threads = 1;
  options.progress = [&](int n, int) { done = n; };
  options.cancelled = [&] { return done >= 10; };
  Diagnostics out;
  SweepOutcome stopped;
  EXPECT_EQ(run_shard(s, folder / "part", options, out, stopped), kExitIncomplete);
  const std::string part = folder / "part/shard-1-of-1.tables.part";
  const std::string kept = test::read_file(part);
  // The last of the ten tables is cut off: its row is computed again.
  folder.write("part/shard-1-of-1.tables.part", kept.substr(0, kept.size() - 20));
  EXPECT_EQ(test::ran(s, folder / "part").earlier, 9u);
  EXPECT_EQ(test::read_file(folder / "part/shard-1-of-1.tables"),
            test::read_file(folder / "whole/shard-1-of-1.tables"));
  EXPECT_FALSE(std::filesystem::exists(part));
}

TEST(WholeTables, ThatAreNotWholeAreMissing) {
  const test::TemporaryFolder folder;
  const Sweep s = test::ready_sweep(study_with(folder, "tables = \"all\"\n"));
  test::ran(s, folder / "o", {1, 2});
  test::ran(s, folder / "o", {2, 2});
  const std::string path = tables_path(folder / "o", {2, 2}), whole = test::read_file(path);
  for (const auto& [text, why] : {std::pair(whole.substr(0, whole.size() / 2), "is cut short"),
                                  std::pair(test::with_first(whole, "ok", "no"), "has changed since it was written")}) {
    folder.write("o/shard-2-of-2.tables", text);
    Diagnostics out;
    std::string summary;
    EXPECT_EQ(merge_sweep(folder / "o", out, summary), kExitRefused);
    EXPECT_TRUE(test::contains(test::messages(out), std::string("shard-2-of-2.tables: ") + why)) << test::messages(out);
    SweepOptions options;
    options.shard = {2, 2};
    Diagnostics again;
    SweepOutcome outcome;
    EXPECT_EQ(run_shard(s, folder / "o", options, again, outcome), kExitOk);
    EXPECT_TRUE(test::contains(test::messages(again), "it is computed again")) << test::messages(again);
    EXPECT_EQ(test::read_file(path), whole);
  }
}

TEST(WholeTables, AreAskedForInWordsThatAreKnown) {
  const test::TemporaryFolder folder;
  const std::string line = folder / "study.toml" + ":4:";
  EXPECT_TRUE(test::contains(error_of(study_with(folder, "tables = \"jumpd\"\n")),
                             line + "10: tables = \"jumpd\": is no class and no event of this study; did you mean"));
  EXPECT_TRUE(test::contains(error_of(study_with(folder, "tables = [3, \"refused\"]\n")),
                             line + "14: tables[2] = \"refused\": names samples that were not solved at all"))
      << error_of(study_with(folder, "tables = [3, \"refused\"]\n"));
  EXPECT_TRUE(test::contains(error_of(study_with(folder, "tables = [3, 23]\n")),
                             line + "14: tables = 23: is no sample of this study: they are 0 to 22"))
      << error_of(study_with(folder, "tables = [3, 23]\n"));
  EXPECT_TRUE(
      test::contains(error_of(study_with(folder, "tables = -1\n")), line + "10: tables = -1: must be an integer"));
  EXPECT_TRUE(
      test::contains(error_of(study_with(folder, "tables = true\n")), line + "10: tables = true: must be \"all\""));
  EXPECT_TRUE(test::contains(error_of(study_with(folder, "tables = []\n")), line + "10: tables"));
}

}  // namespace
}  // namespace genu
