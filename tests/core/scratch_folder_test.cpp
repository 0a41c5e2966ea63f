#include "genu/core/scratch_folder.h"

#include <cstdlib>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

/// TMPDIR for as long as a test lasts.
class TemporaryIs {
 public:
  explicit TemporaryIs(const std::string& folder) {
    if (const char* old = std::getenv("TMPDIR")) before_ = old;
    ::setenv("TMPDIR", folder.c_str(), 1);
  }
  ~TemporaryIs() {
    if (before_.empty())
      ::unsetenv("TMPDIR");
    else
      ::setenv("TMPDIR", before_.c_str(), 1);
  }

 private:
  std::string before_;
};

TEST(ScratchFolder, IsThereForAWhileWithAllThatIsInIt) {
  fs::path path;
  {
    const ScratchFolder folder("genu-scratch"), other("genu-scratch");
    path = folder.path();
    EXPECT_TRUE(fs::is_directory(path));
    EXPECT_NE(path, other.path());
    EXPECT_TRUE(folder.problem().empty());
    fs::create_directories(path / "a" / "b");
    std::ofstream(path / "a" / "file") << "x";
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(ScratchFolder, WhatIsNoTemporaryFolderIsNamed) {
  const test::TemporaryFolder folder;
  const TemporaryIs missing(folder / "missing");
  const ScratchFolder scratch("genu-scratch");
  EXPECT_TRUE(scratch.path().empty());
  EXPECT_NE(scratch.problem().find(folder / "missing"), std::string::npos) << scratch.problem();
}

}  // namespace
}  // namespace genu
