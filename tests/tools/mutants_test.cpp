// tools/mutants --check, in a small tree: a patch that no longer applies, one that no case names, and a safeguard
// without one are each an error with its name. The tree's own patches are the test `mutants_apply`.
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "support/places.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

constexpr char kSource[] = "double half(double x) {\n  if (x < 0) return 0;\n  return x / 2;\n}\n";
constexpr char kPatch[] =
    "Half of a negative number is negative.\n\n--- a/src/half.cpp\n+++ b/src/half.cpp\n@@ -1,3 +1,2 @@\n"
    " double half(double x) {\n-  if (x < 0) return 0;\n   return x / 2;\n";

/// A tree with one source, one mutant and one case that names it.
class Mutants : public ::testing::Test {
 protected:
  Mutants() {
    namespace fs = std::filesystem;
    for (const char* part : {"src", "tools", "tests/hard_cases/mutants", "tests/hard_cases/family"})
      fs::create_directories(folder_ / part);
    fs::copy_file(test::source_folder() + "/tools/mutants", folder_ / "tools/mutants");
    folder_.write("src/half.cpp", kSource);
    folder_.write("tests/hard_cases/mutants/sign.patch", kPatch);
    folder_.write("tests/hard_cases/family/x.expect.toml", "why = \"x\"\nsafeguard = \"sign\"\n");
  }

  /// The exit code of tools/mutants; `said_` is what it printed.
  int run(const std::string& arguments) {
    const std::string command =
        "'" + (folder_ / "tools/mutants") + "' " + arguments + " >'" + (folder_ / "said") + "' 2>&1";
    const int status = std::system(command.c_str());
    said_ = test::read_file(folder_ / "said");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  bool says(const std::string& words) const { return said_.find(words) != std::string::npos; }

  test::TemporaryFolder folder_;
  std::string said_;
};

TEST_F(Mutants, ApplyToTheTreeThatTheyWereMadeFor) {
  EXPECT_EQ(run("--check"), 0) << said_;
  EXPECT_EQ(run("--check sign"), 0) << said_;
  EXPECT_EQ(test::read_file(folder_ / "src/half.cpp"), kSource) << "a check changes nothing";
}

TEST_F(Mutants, ThatNoLongerApplyAreNamed) {
  folder_.write("src/half.cpp", "double half(double x) {\n  if (x <= 0) return 0;\n  return x / 2;\n}\n");
  EXPECT_EQ(run("--check"), 1);
  EXPECT_TRUE(says("tests/hard_cases/mutants/sign.patch no longer applies")) << said_;
}

TEST_F(Mutants, AreNamedByCasesAndCasesNameNoOthers) {
  folder_.write("tests/hard_cases/family/x.expect.toml", "why = \"x\"\nsafeguard = \"belt\"\n");
  EXPECT_EQ(run("--check"), 1);
  EXPECT_TRUE(says("no case names this safeguard")) << said_;
  EXPECT_TRUE(says("tests/hard_cases/mutants/belt.patch is missing")) << said_;
}

TEST_F(Mutants, AreNotMadeInAFolderOfOtherFiles) {
  EXPECT_EQ(run("--folder src sign"), 2);
  EXPECT_TRUE(says("src: holds other files")) << said_;
  EXPECT_EQ(test::read_file(folder_ / "src/half.cpp"), kSource);
}

TEST_F(Mutants, OfOtherNamesAreRefused) {
  EXPECT_EQ(run("--check belt"), 2);
  EXPECT_TRUE(says("belt: there is no tests/hard_cases/mutants/belt.patch")) << said_;
}

}  // namespace
}  // namespace genu
