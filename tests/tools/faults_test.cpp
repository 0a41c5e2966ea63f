// genu killed, out of room, out of memory: what is left, what is said, and how it goes on. Real processes.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>

#include "support/places.h"
#include "tools/cli_scenes.h"

namespace genu::test {
namespace {

namespace fs = std::filesystem;

/// The knee of Dortmans in so many poses that a run takes a second or two.
std::string long_scene(const TemporaryFolder& folder, int increments) {
  const std::string text = read_file(genu::test::source_folder() + "/meshes/dortmans1984/scene.toml");
  return folder.write("knee.toml", with_first(text, "increments = 70", "increments = " + std::to_string(increments)));
}

struct Limits {
  rlim_t file = RLIM_INFINITY, memory = RLIM_INFINITY;  // bytes
};

/// Starts `genu run SCENE --out OUT --quiet [--resume]`; its messages go to the file `said`.
pid_t start(const std::string& scene, const std::string& out, const std::string& said, bool resume = false,
            Limits limits = {}) {
  const pid_t child = fork();
  if (child != 0) return child;
  const int log = open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  dup2(log, STDERR_FILENO);
  const rlimit file{limits.file, limits.file}, memory{limits.memory, limits.memory};
  setrlimit(RLIMIT_FSIZE, &file);
  setrlimit(RLIMIT_AS, &memory);
  execl(genu::test::program().c_str(), "genu", "run", scene.c_str(), "--out", out.c_str(), "--quiet", "--checkpoint",
        "0.05", resume ? "--resume" : nullptr, nullptr);
  _exit(127);
}

/// The exit code; -1 where a signal ended it.
int end_of(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

double seconds_of(pid_t child) {
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(end_of(child), 0);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void wait(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

class Faults : public ::testing::Test {
 protected:
  /// One undisturbed run for all tests, that lasts much longer than what lies between two parts of its checkpoint.
  static void SetUpTestSuite() {
    shared_ = new TemporaryFolder;
    for (int rows = 20'000; lasts_ < 1.2 && rows < 1'000'000; rows *= 2)
      lasts_ = seconds_of(start(long_scene(*shared_, rows), *shared_ / "whole", *shared_ / "said"));
  }
  static void TearDownTestSuite() {
    delete shared_;
    shared_ = nullptr;
  }
  static std::string whole() { return *shared_ / "whole"; }
  static void wait_for(const std::string& file) {
    for (int k = 0; k < 3000 && !fs::exists(file); ++k) wait(0.01);
  }
  std::string out() const { return folder_ / "out"; }
  std::string said() const { return read_file(folder_ / "said"); }
  pid_t run(const std::string& to, bool resume = false, Limits limits = {}) const {
    return start(*shared_ / "knee.toml", folder_ / to, folder_ / "said", resume, limits);
  }
  void expect_whole(const std::string& name) const {
    EXPECT_EQ(read_file(folder_ / name + "/results.csv"), read_file(whole() + "/results.csv"));
    EXPECT_EQ(read_file(folder_ / name + "/events.csv"), read_file(whole() + "/events.csv"));
    EXPECT_FALSE(read_file(folder_ / name + "/results.csv").empty());
  }
  const TemporaryFolder folder_;
  static inline TemporaryFolder* shared_ = nullptr;
  static inline double lasts_ = 0;  // s
};

/// GENU_KILLS kills at random times, 8 where it does not say: tools/test --long asks for 50.
TEST_F(Faults, KilledAtAnyMomentARunGoesOnToTheSameBytes) {
  const char* asked = std::getenv("GENU_KILLS");
  const int kills = asked != nullptr ? std::max(1, std::atoi(asked)) : 8;
  std::mt19937 random(20'261'122);
  std::uniform_real_distribution<double> moment(0, 1);
  int went_on = 0;
  fs::copy(whole(), out(), fs::copy_options::recursive);
  const std::string before = read_file(folder_ / "out/summary.json");
  for (int k = 0; k < kills; ++k) {
    const pid_t child = run("out", k % 2 == 1);  // every other run goes on from what the one before has left
    wait(moment(random) * lasts_);
    kill(child, SIGKILL);
    const bool killed = end_of(child) == -1;
    expect_whole("out");  // the earlier result, or the new one
    if (killed && fs::exists(folder_ / "out.checkpoint")) ++went_on;
    EXPECT_FALSE(read_file(folder_ / "out/summary.json").empty());
  }
  EXPECT_EQ(end_of(run("out", true)), 0) << said();
  expect_whole("out");
  EXPECT_NE(read_file(folder_ / "out/summary.json"), before);
  EXPECT_FALSE(fs::exists(folder_ / "out.checkpoint"));
  EXPECT_GT(went_on, 0);
}

TEST_F(Faults, AKilledRunWithoutAnEarlierResultLeavesNoneAndGoesOn) {
  const pid_t child = run("out");
  wait_for(folder_ / "out.checkpoint");
  wait(0.02);
  kill(child, SIGKILL);
  ASSERT_EQ(end_of(child), -1);
  EXPECT_FALSE(fs::exists(out()));
  ASSERT_TRUE(fs::exists(folder_ / "out.checkpoint"));
  EXPECT_EQ(end_of(run("out", true)), 0) << said();
  expect_whole("out");
}

TEST_F(Faults, CtrlCKeepsTheRowsMarkedPartialAndSaysHowToGoOn) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    fs::remove(folder_ / "out.checkpoint");
    const pid_t child = run("out");
    wait_for(folder_ / "out.checkpoint");
    wait(0.02);
    kill(child, signal);
    EXPECT_EQ(end_of(child), 3) << said();
    EXPECT_TRUE(contains(said(), "PARTIAL: interrupted after ")) << said();
    EXPECT_TRUE(contains(said(), "--resume continues from row ")) << said();
    EXPECT_TRUE(contains(read_file(folder_ / "out.partial/summary.json"), "\"partial\": true"));
    EXPECT_FALSE(fs::exists(out()));
  }
  EXPECT_EQ(end_of(run("out", true)), 0) << said();
  expect_whole("out");
  EXPECT_FALSE(fs::exists(folder_ / "out.partial"));
}

TEST_F(Faults, AFullDiskLeavesTheEarlierResultAndSaysWhatIsKept) {
  fs::copy(whole(), out(), fs::copy_options::recursive);
  EXPECT_EQ(end_of(run("out", false, {.file = 1'000'000})), 1);
  // A slow machine has kept rows in a checkpoint by then.
  EXPECT_TRUE(contains(said(), "File too large; no row of this run is kept, earlier results are untouched") ||
              contains(said(), "rows are kept in " + out() + ".checkpoint"))
      << said();
  expect_whole("out");
  for (const auto& entry : fs::directory_iterator(folder_ / ""))
    EXPECT_FALSE(contains(entry.path().filename().string(), ".out.partial")) << entry.path();
}

TEST_F(Faults, AFolderThatTurnsIntoAFileLosesNoRowsOfTheCheckpoint) {
  const pid_t child = run("out");
  wait_for(folder_ / "out.checkpoint");
  folder_.write("out", "in the way");
  EXPECT_EQ(end_of(child), 1);
  EXPECT_TRUE(contains(said(), "is a file: choose a folder")) << said();
  EXPECT_TRUE(contains(said(), " rows are kept in ")) << said();
  EXPECT_EQ(read_file(out()), "in the way");
  fs::remove(out());
  EXPECT_EQ(end_of(run("out", true)), 0) << said();
  expect_whole("out");
}

TEST_F(Faults, AMemoryLimitIsToldAndTheRunGoesOnWithMore) {
  fs::copy(whole(), out(), fs::copy_options::recursive);
  constexpr rlim_t kLittle = rlim_t{170} << 20;
  EXPECT_EQ(end_of(run("out", false, {.memory = kLittle})), 1) << said();
  EXPECT_TRUE(contains(said(), "out of memory")) << said();
  EXPECT_FALSE(contains(said(), "terminate")) << said();
  expect_whole("out");
  const bool kept = fs::exists(folder_ / "out.checkpoint");
  EXPECT_EQ(kept, contains(said(), "--resume")) << said();
  EXPECT_EQ(end_of(run("out", true)), 0) << said();
  expect_whole("out");
}

TEST_F(Faults, AFailureIsSeenAgainFromOneFile) {
  const std::string text = with_first(kBall, "radius = 20", "radius = -20");
  const std::string scene = folder_.write("ball.toml", text), file = folder_ / "failure.json";
  EXPECT_EQ(genu("run " + scene + " --out " + out() + " --save-failure " + file).exit_code, 2);
  EXPECT_EQ(genu("run " + scene + " --out " + out() + " --save-failure \"\"").exit_code, 2);
  fs::remove(scene);
  const Outcome again = genu("reproduce " + file);
  EXPECT_EQ(again.exit_code, 0) << again.out << again.err;
  EXPECT_TRUE(contains(again.out, "fails in the same way")) << again.out;
  EXPECT_EQ(genu("reproduce " + file + " --out " + (folder_ / "unpacked")).exit_code, 0);
  EXPECT_EQ(read_file(folder_ / "unpacked/scene.toml"), text);
  EXPECT_EQ(genu("reproduce " + (folder_ / "said")).exit_code, 2);
}

}  // namespace
}  // namespace genu::test
