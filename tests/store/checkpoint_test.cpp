// A run that is stopped anywhere goes on to the bytes of an undisturbed run; what cannot be trusted is not.
#include "genu/store/checkpoint.h"

#include <sys/stat.h>

#include <filesystem>
#include <new>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/study/run_scene.h"
#include "support/judged.h"
#include "support/meshed_scene.h"
#include "support/places.h"
#include "support/scenes.h"
#include "support/text.h"

namespace genu {
namespace {

namespace fs = std::filesystem;
using test::read_file;
using test::with_first;

/// The knee of Dortmans, bent in 70 increments, then back by arc length, and forward again.
std::string three_steps() {
  const std::string text = read_file(test::dortmans_file()), step = text.substr(text.find("[[step]]"));
  return text +
         with_first(with_first(step, "[0, 70]", "[70, 50]"), "increments = 70",
                    "increments = 20\ncontrol = \"arc_length\"") +
         with_first(with_first(step, "[0, 70]", "[50, 60]"), "increments = 70", "increments = 40");
}

struct Ended {
  int code = -1;
  Diagnostics out;
  Solution found;
};

/// Writes checkpoints at every rest; stops when `rows` rows are there.
Ended run(const std::string& scene, const std::string& folder, int rows, bool resume) {
  Ended r;
  bool stop = false;
  RunOptions options;
  options.checkpoint_seconds = 0;
  options.resume = resume;
  options.progress = [&](int done, int) { stop = done >= rows; };
  options.cancelled = [&] { return stop; };
  r.code = test::judged_run(scene, folder, options, r.out, &r.found);
  return r;
}

constexpr int kNever = 1 << 20;

void expect_same_results(const std::string& a, const std::string& b) {
  EXPECT_FALSE(read_file(a + "/results.csv").empty());
  EXPECT_EQ(read_file(a + "/results.csv"), read_file(b + "/results.csv"));
  EXPECT_EQ(read_file(a + "/events.csv"), read_file(b + "/events.csv"));
}

/// Stopped at some rows, each time by a run that goes on from the one before.
void stop_and_go_on(const std::string& scene, const test::TemporaryFolder& folder, const std::vector<int>& rows) {
  const Ended whole = run(scene, folder / "whole", kNever, false);
  ASSERT_LE(whole.code, 3) << test::messages(whole.out);
  EXPECT_FALSE(fs::exists(folder / "whole.checkpoint"));
  for (const int row : rows) {
    const Ended part = run(scene, folder / "out", row, row != rows.front());
    EXPECT_EQ(part.code, kExitIncomplete) << row;
    EXPECT_TRUE(part.found.summary.partial);
    EXPECT_EQ(part.found.folder, folder / "out.partial");
    EXPECT_TRUE(test::contains(read_file(folder / "out.partial/summary.json"), "\"partial\": true"));
    EXPECT_TRUE(fs::exists(folder / "out.partial/results.partial.csv"));
    EXPECT_FALSE(fs::exists(folder / "out"));
    EXPECT_TRUE(test::contains(part.found.summary.verdict.front(), "--resume continues from row"));
  }
  int first_row = 0;
  Ended last;
  RunOptions options;
  options.resume = true;
  options.progress = [&](int done, int) { first_row = first_row == 0 ? done : first_row; };
  EXPECT_EQ(test::judged_run(scene, folder / "out", options, last.out, nullptr), whole.code)
      << test::messages(last.out);
  EXPECT_GT(first_row, 16);  // not from the start
  expect_same_results(folder / "out", folder / "whole");
  EXPECT_FALSE(fs::exists(folder / "out.checkpoint"));
  EXPECT_FALSE(fs::exists(folder / "out.partial"));
}

TEST(Checkpoint, AKneeGoesOnToTheSameBytes) {
  const test::TemporaryFolder folder;
  stop_and_go_on(folder.write("knee.toml", three_steps()), folder, {17, 40, 50, 75, 95, 125});
}

TEST(Checkpoint, SoDoMeshes) {
  const test::TemporaryFolder folder;
  const std::string scene = test::meshed_scene(folder);
  folder.write("scene.toml", with_first(read_file(scene), "increments = 6", "increments = 30"));
  stop_and_go_on(scene, folder, {20});
}

TEST(Checkpoint, SoDoesACartilageLayer) {
  const test::TemporaryFolder folder;
  std::string text = read_file(test::dortmans_file());
  for (int k = 0; k < 2; ++k)
    text = with_first(text, "model = \"rigid\"", "model = \"cartilage\"\nmodulus = 10\npoisson = 0.4\nthickness = 4");
  stop_and_go_on(folder.write("knee.toml", with_first(text, "increments = 70", "increments = 20")), folder, {17});
}

TEST(Checkpoint, AnEarlierResultIsUntouchedUntilTheNextIsWhole) {
  const test::TemporaryFolder folder;
  const std::string scene = folder.write("knee.toml", three_steps());
  ASSERT_EQ(run(scene, folder / "out", kNever, false).code, kExitOk);
  const std::string before = read_file(folder / "out/summary.json");
  ASSERT_EQ(run(scene, folder / "out", 30, false).code, kExitIncomplete);
  EXPECT_EQ(read_file(folder / "out/summary.json"), before);
  ASSERT_EQ(run(scene, folder / "out", kNever, true).code, kExitOk);
  EXPECT_NE(read_file(folder / "out/summary.json"), before);
}

TEST(Checkpoint, AChangedSceneOrMeshIsRefused) {
  const test::TemporaryFolder folder;
  const std::string scene = test::meshed_scene(folder);
  folder.write("scene.toml", with_first(read_file(scene), "increments = 6", "increments = 30"));
  ASSERT_EQ(run(scene, folder / "out", 20, false).code, kExitIncomplete);
  const std::string kept = read_file(scene), mesh = read_file(folder / "femur_medial.ply");
  folder.write("scene.toml", kept + "# changed\n");
  Ended changed = run(scene, folder / "out", kNever, true);
  EXPECT_EQ(changed.code, kExitRefused);
  EXPECT_TRUE(test::contains(test::messages(changed.out), "scene.toml: has changed since"))
      << test::messages(changed.out);
  folder.write("scene.toml", kept);
  std::string other = mesh;
  const std::size_t number = other.find("end_header\n") + 11 + 240;  // the last digits of a coordinate
  other[number] = static_cast<char>(other[number] ^ 1);
  folder.write("femur_medial.ply", other);
  changed = run(scene, folder / "out", kNever, true);
  EXPECT_EQ(changed.code, kExitRefused);
  EXPECT_TRUE(test::contains(test::messages(changed.out), "femur_medial.ply: has changed since"));
  folder.write("femur_medial.ply", mesh);
  EXPECT_EQ(run(scene, folder / "out", kNever, true).code, kExitOk);
}

TEST(Checkpoint, WhatIsCutOffOrGarbledIsLeftOutAndSaid) {
  const test::TemporaryFolder folder;
  const std::string scene = folder.write("knee.toml", three_steps());
  ASSERT_EQ(run(scene, folder / "whole", kNever, false).code, kExitOk);
  ASSERT_EQ(run(scene, folder / "out", 120, false).code, kExitIncomplete);
  const std::string kept = read_file(folder / "out.checkpoint");
  ASSERT_GT(kept.size(), 10'000u);
  const auto go_on = [&](const std::string& bytes, const std::string& said) {
    folder.write("out.checkpoint", bytes);
    const Ended r = run(scene, folder / "out", kNever, true);
    EXPECT_EQ(r.code, kExitOk) << test::messages(r.out);
    EXPECT_TRUE(test::contains(test::messages(r.out), said)) << test::messages(r.out);
    expect_same_results(folder / "out", folder / "whole");
  };
  for (const double share : {0.001, 0.02, 0.3, 0.7, 0.999})
    go_on(kept.substr(0, static_cast<std::size_t>(share * static_cast<double>(kept.size()))), "");
  go_on(kept.substr(0, kept.size() - 1), "are damaged and left out");
  for (const double share : {0.3, 0.6, 0.95}) {
    std::string garbled = kept;
    const auto place = static_cast<std::size_t>(share * static_cast<double>(kept.size()));
    garbled[place] = static_cast<char>(garbled[place] ^ 16);
    go_on(garbled, "are damaged and left out");
  }
  go_on("", "");
}

TEST(Checkpoint, AFileOfSomebodyElseIsNeitherReadNorReplaced) {
  const test::TemporaryFolder folder;
  const std::string scene = folder.write("knee.toml", three_steps());
  folder.write("out.checkpoint", "years of work");
  const Ended r = run(scene, folder / "out", kNever, true);
  EXPECT_EQ(r.code, kExitRefused);
  EXPECT_TRUE(test::contains(test::messages(r.out), "is no checkpoint of genu"));
  EXPECT_EQ(run(scene, folder / "out", kNever, false).code, kExitOk);
  EXPECT_EQ(read_file(folder / "out.checkpoint"), "years of work");
}

TEST(Checkpoint, APipeIsNeitherWaitedForNorReplaced) {
  const test::TemporaryFolder folder;
  const std::string scene = folder.write("knee.toml", three_steps()), pipe = folder / "out.checkpoint";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const Ended r = run(scene, folder / "out", kNever, true);
  EXPECT_EQ(r.code, kExitRefused);
  EXPECT_TRUE(test::contains(test::messages(r.out), "is no regular file"));
  EXPECT_EQ(run(scene, folder / "out", kNever, false).code, kExitOk);
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST(Checkpoint, WhatWasFoundBeforeMemoryEndedIsKept) {
  const test::TemporaryFolder folder;
  const std::string scene = folder.write("knee.toml", three_steps());
  ASSERT_EQ(run(scene, folder / "whole", kNever, false).code, kExitOk);
  RunOptions options;
  options.checkpoint_seconds = 0;
  options.progress = [](int done, int) {
    if (done == 40) throw std::bad_alloc();
  };
  Diagnostics out;
  Solution found;
  EXPECT_EQ(test::judged_run(scene, folder / "out", options, out, &found), kExitFailed);
  EXPECT_EQ(found.poses.rows(), 40u);
  EXPECT_TRUE(test::contains(found.summary.verdict.front(), "out of memory after 40 of")) << found.summary.verdict[0];
  EXPECT_TRUE(fs::exists(folder / "out.partial/results.partial.csv"));
  EXPECT_EQ(run(scene, folder / "out", kNever, true).code, kExitOk);
  expect_same_results(folder / "out", folder / "whole");
}

TEST(Checkpoint, WhatCannotBeWrittenIsNotSaidToBeKept) {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "out.partial");
  folder.write("out.partial/thesis.txt", "kept");
  RunOptions options;
  options.progress = [](int done, int) {
    if (done == 10) throw std::bad_alloc();
  };
  Diagnostics out;
  Solution found;
  EXPECT_EQ(test::judged_run(test::dortmans_file(), folder / "out", options, out, &found), kExitFailed);
  EXPECT_TRUE(out.has_errors());
  const std::string said = found.summary.verdict.front();
  EXPECT_TRUE(test::contains(said, "10 of 71 rows, which could not be written")) << said;
  EXPECT_EQ(test::read_file(folder / "out.partial/thesis.txt"), "kept");
}

TEST(Checkpoint, AShortRunWritesNone) {
  const test::TemporaryFolder folder;
  bool any = false;
  RunOptions options;
  options.progress = [&](int, int) { any = any || fs::exists(folder / "out.checkpoint"); };
  Diagnostics out;
  EXPECT_EQ(test::judged_run(test::dortmans_file(), folder / "out", options, out, nullptr), kExitOk);
  EXPECT_FALSE(any);
}

TEST(Checkpoint, ARunTooShortToWriteOneNamesTheOneBefore) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(run(test::dortmans_file(), folder / "out", 40, false).code, kExitIncomplete);
  RunOptions options;
  bool stop = false;
  options.progress = [&](int, int) { stop = true; };
  options.cancelled = [&] { return stop; };
  Diagnostics out;
  Solution found;
  EXPECT_EQ(test::judged_run(test::dortmans_file(), folder / "out", options, out, &found), kExitIncomplete);
  const std::string said = found.summary.verdict.front();
  EXPECT_TRUE(test::contains(said, "--resume continues from the rows of an earlier run in")) << said;
}

TEST(Checkpoint, AMotionIsComputedAnewAndSaysSo) {
  const test::TemporaryFolder folder;
  const std::string scene = genu::test::source_folder() + "/meshes/leskovar2019/scene.toml";
  const Ended whole = run(scene, folder / "whole", kNever, false), part = run(scene, folder / "out", 300, false);
  EXPECT_EQ(part.code, kExitIncomplete);
  EXPECT_TRUE(test::contains(part.found.summary.verdict.front(), "computes them again"));
  const Ended again = run(scene, folder / "out", kNever, true);
  EXPECT_EQ(again.code, whole.code);
  EXPECT_TRUE(test::contains(test::messages(again.out), "a motion is computed again"));
  expect_same_results(folder / "out", folder / "whole");
}

}  // namespace
}  // namespace genu
