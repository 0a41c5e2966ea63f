#include "genu/store/compare.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "genu/study/run_scene.h"
#include "support/judged.h"
#include "support/scenes.h"
#include "support/text.h"

namespace genu {
namespace {

TEST(Compare, WritesOnePageOfResultsOrRefusesAllThatAreNone) {
  test::TemporaryFolder folder;
  Diagnostics out;
  RunOptions options;
  options.report = true;
  ASSERT_EQ(test::judged_run(test::dortmans_file(), folder / "a", options, out, nullptr), kExitOk)
      << test::messages(out);
  std::filesystem::create_directory(folder / "deep");
  std::filesystem::copy(folder / "a", folder / "deep/a");
  const std::string page = folder / "both.html";
  ASSERT_EQ(compare_results({folder / "a", folder / "deep/a/report.html"}, page, out), kExitOk) << test::messages(out);
  const std::string text = test::read_file(page);
  EXPECT_TRUE(test::contains(text, "\"name\":\"a\""));
  EXPECT_TRUE(test::contains(text, "\"name\":\"" + (folder / "deep/a/report.html") + "\""));  // two of one name
  EXPECT_EQ(compare_results({folder / "a", folder / "deep/a/report.html"}, page, out), kExitOk);
  EXPECT_EQ(test::read_file(page), text);

  Diagnostics refused;
  EXPECT_EQ(compare_results({folder / "none", folder / "deep", folder / "a/results.csv", folder / "a"}, folder / "x",
                            refused),
            kExitRefused);
  const std::string said = test::messages(refused);
  for (const char* part : {"none: is not there", "deep: holds no report.html", "results.csv: is no report.html"})
    EXPECT_TRUE(test::contains(said, part)) << said;
  EXPECT_FALSE(std::filesystem::exists(folder / "x"));
  Diagnostics one;
  EXPECT_EQ(compare_results({folder / "a"}, folder / "x", one), kExitRefused);
  Diagnostics nowhere;
  EXPECT_EQ(compare_results({folder / "a", folder / "a"}, folder / "no/such/folder.html", nowhere), kExitRefused);
  EXPECT_TRUE(test::contains(test::messages(nowhere), "no such folder"));
}

}  // namespace
}  // namespace genu
