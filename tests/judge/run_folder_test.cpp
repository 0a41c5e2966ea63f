// A folder that a run wrote, and all that may have become of it since.
#include "genu/judge/run_folder.h"

#include <array>
#include <filesystem>
#include <vector>

#include <gtest/gtest.h>

#include "genu/core/file_checksum.h"
#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu {
namespace {

const std::string kTable = "step,status\n1,ok\n1,no_equilibrium\n";

class RunFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(folder_ / "out");
    folder_.write("scene.toml", "format = 1\n");
  }

  std::string summary(const std::string& partial = "false", const std::string& counts = "{ \"solved\": 1 }") const {
    return "{ \"scene_path\": \"" + (folder_ / "scene.toml") + "\", \"partial\": " + partial +
           ", \"files\": [{ \"path\": \"" + (folder_ / "scene.toml") + "\", \"xxh128\": \"" +
           checksum("format = 1\n").xxh128 + "\" }], \"results\": { \"rows\": 2, \"xxh128\": \"" +
           checksum(kTable).xxh128 + "\" }, \"poses\": " + counts + " }";
  }
  /// What is said of it; empty where nothing is.
  std::string said(const std::string& json, const std::string& table = kTable) {
    folder_.write("out/summary.json", json);
    folder_.write("out/results.csv", table);
    Diagnostics out;
    const auto found = judge::read_run_folder(folder_ / "out", {}, out);
    EXPECT_EQ(found.has_value(), !out.has_errors());
    if (found) {
      EXPECT_EQ(found->ok_rows, 1U);
    }
    std::string text;
    for (const Diagnostic& d : out.items()) text += to_string(d) + "\n";
    return text;
  }
  static std::string changed(std::string text, const std::string& what, const std::string& with) {
    const auto where = text.find(what);
    EXPECT_NE(where, std::string::npos) << what;
    return where == std::string::npos ? text : text.replace(where, what.size(), with);
  }

  const test::TemporaryFolder folder_;
};

TEST_F(RunFolder, AsItWasWritten) { EXPECT_EQ(said(summary()), ""); }

TEST_F(RunFolder, TheChangesOfTheSceneAreRead) {
  const std::string mark = "\"partial\"", changes = "\"changes\": { \"without\": [\"ACL*\"], \"set\": [\"a.b=2\"] }, ";
  EXPECT_EQ(said(changed(summary(), mark, changes + mark)), "");
  Diagnostics out;
  const auto found = judge::read_run_folder(folder_ / "out", {}, out);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->scene.changes.without, std::vector<std::string>{"ACL*"});
  EXPECT_EQ(found->scene.changes.set, std::vector<std::string>{"a.b=2"});
  const std::string wrong = said(changed(summary(), mark, "\"changes\": { \"without\": 3 }, " + mark));
  EXPECT_TRUE(test::contains(wrong, "`changes` is not what a run writes")) << wrong;
}

TEST_F(RunFolder, WithRowsCutThatAreNotOk) {
  const std::string cut = said(summary(), "step,status\n1,ok\n");
  EXPECT_TRUE(test::contains(cut, "has 1 rows where the run wrote 2")) << cut;
  EXPECT_TRUE(test::contains(said(summary(), ""), "has 0 rows where the run wrote 2"));
}

TEST_F(RunFolder, WithOtherBytes) {
  EXPECT_TRUE(test::contains(said(summary(), changed(kTable, "no_eq", "no_Eq")), "it has changed since"));
  folder_.write("scene.toml", "format = 2\n");
  EXPECT_TRUE(test::contains(said(summary()), "has changed since the run"));
  EXPECT_TRUE(test::contains(said(summary("true")), "is partial"));
}

TEST_F(RunFolder, WithASummaryThatNoRunWrites) {
  const std::string good = summary();
  for (const auto& [what, with, key] :
       std::vector<std::array<std::string, 3>>{{"\"partial\": false", "\"partial\": \"no\"", "partial"},
                                               {"\"partial\": false", "\"partial\": 0", "partial"},
                                               {"\"files\": [", "\"file\": [", "files"},
                                               {"\"xxh128\"", "\"xxh\"", "files"},
                                               {"\"rows\": 2", "\"rows\": -2", "results"},
                                               {"\"results\": {", "\"result\": {", "results"},
                                               {"{ \"solved\": 1 }", "{ \"solved\": \"1\" }", "poses"},
                                               {"{ \"solved\": 1 }", "7", "poses"},
                                               {"{ \"solved\": 1 }", "null", "poses"}}) {
    const std::string text = said(changed(good, what, with));
    EXPECT_TRUE(test::contains(text, "`" + key + "` is missing or not what a run writes")) << with << "\n" << text;
  }
  const std::string old =
      said("{ \"genu\": \"0.1.0\", \"results\": { \"bytes\": 9, \"fnv1a64\": \"af63dc4c8601ec8c\" } }");
  EXPECT_TRUE(test::contains(old, "has checksums of another version of genu, \"0.1.0\"")) << old;
  for (const char* none : {"", "[]", "7", "{", "{}"}) EXPECT_NE(said(none), "") << none;
}

}  // namespace
}  // namespace genu
