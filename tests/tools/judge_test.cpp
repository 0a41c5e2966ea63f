// genu judge on what is no whole result: told, and never accepted.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "tools/cli_scenes.h"

namespace genu::test {
namespace {

class CliJudge : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(genu("new " + (folder_ / "knee")).exit_code, 0);
    ASSERT_EQ(genu("run " + (folder_ / "knee/knee.toml") + " --out " + out()).exit_code, 0);
  }
  std::string out() const { return folder_ / "out"; }
  void rewrite(const std::string& text) const { folder_.write("out/results.csv", text); }

  const TemporaryFolder folder_;
};

TEST_F(CliJudge, AcceptsTheRunAndTheSameTextFromAnotherProgram) {
  const Outcome judged = genu("judge " + out());
  EXPECT_EQ(judged.exit_code, 0) << judged.out << judged.err;
  std::string text = read_file(out() + "/results.csv"), saved = "\xef\xbb\xbf";
  for (const char c : text) saved += c == '\n' ? std::string("\r\n") : std::string(1, c);
  rewrite(saved);
  const Outcome again = genu("judge " + out());
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.out, judged.out);
}

TEST_F(CliJudge, KeepsTheDoubtsOfARun) {
  EXPECT_FALSE(contains(genu("judge " + out()).out, "doubts"));
  const std::string text =
      with_first(read_file(folder_ / "knee/knee.toml"), "[[step]]", "[plausible]\nligament_force = 1\n\n[[step]]");
  const std::string scene = folder_.write("knee/doubtful.toml", text), folder = folder_ / "doubtful";
  ASSERT_EQ(genu("run " + scene + " --out " + folder).exit_code, 4);
  const Outcome judged = genu("judge " + folder);
  EXPECT_EQ(judged.exit_code, 0) << judged.err;
  EXPECT_TRUE(contains(judged.out, "the run has doubts, which no balance of forces settles: Solved, but "))
      << judged.out;
}

TEST_F(CliJudge, RefusesWhatWasCutOrHasOtherWords) {
  const std::string text = read_file(out() + "/results.csv");
  rewrite(text.substr(0, text.rfind('\n', text.size() - 2) + 1));
  const Outcome cut = genu("judge " + out());
  EXPECT_EQ(cut.exit_code, 2);
  EXPECT_TRUE(contains(cut.err, "it was cut or added to")) << cut.err;
  std::string other = text;
  other.replace(other.find(",ok,"), 4, ",fine,");
  rewrite(other);
  const Outcome unknown = genu("judge " + out());
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_TRUE(contains(unknown.err, "is no status")) << unknown.err;
}

TEST_F(CliJudge, TellsAnotherSceneAndWritesOverNothingElse) {
  const std::string scene = read_file(folder_ / "knee/knee.toml");
  const std::string other = folder_.write("other.toml", scene + "\n# changed\n");
  const Outcome judged = genu("judge " + out() + " --scene " + other);
  EXPECT_TRUE(contains(judged.err, "is not, byte for byte, the scene")) << judged.err;
  const std::string mine = folder_.write("mine.json", "{}");
  EXPECT_EQ(genu("judge " + out() + " --out " + mine).exit_code, 2);
  EXPECT_EQ(read_file(mine), "{}");
  EXPECT_EQ(genu("judge " + out() + " --out " + (folder_ / "none/checks.json")).exit_code, 2);
  EXPECT_EQ(genu("judge " + out() + " --out " + (folder_ / "checks.json")).exit_code, 0);
}

// Results keep what others put beside them; other kinds of results are not replaced.
TEST_F(CliJudge, AnotherRunKeepsWhatLiesBesideItsResults) {
  folder_.write("out/notes.txt", "mine");
  const std::string run = "run " + (folder_ / "knee/knee.toml") + " --out ";
  ASSERT_EQ(genu(run + out() + "/nested").exit_code, 0);
  ASSERT_EQ(genu(run + out()).exit_code, 0);
  EXPECT_EQ(read_file(out() + "/notes.txt"), "mine");
  EXPECT_TRUE(std::filesystem::exists(out() + "/nested/results.csv"));
  ASSERT_EQ(genu(run + (folder_ / "other")).exit_code, 0);
  const Outcome refused = genu("convert " + out() + " --to vtk --out " + (folder_ / "other"));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(contains(refused.err, "holds genu's results")) << refused.err;
  const std::string theirs = folder_.write("theirs.mot", "measured");
  EXPECT_EQ(genu("convert " + out() + " --out " + theirs).exit_code, 2);
  EXPECT_EQ(read_file(theirs), "measured");
}

}  // namespace
}  // namespace genu::test
