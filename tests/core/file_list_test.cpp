#include "genu/core/file_list.h"

#include <fstream>

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

TEST(FileList, NamesWhatWasThereAndTellsWhatCameLater) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "maps/deep");
  folder.write("results.csv", "x");
  folder.write("maps/deep/map.csv", "x");
  ASSERT_EQ(write_file_list(folder / ".", "results"), "");
  const auto list = read_file_list(folder / ".");
  ASSERT_TRUE(list);
  EXPECT_EQ(list->kind, "results");
  EXPECT_EQ(list->files, (std::set<std::string>{"maps/deep/map.csv", "results.csv"}));
  EXPECT_TRUE(not_listed(folder / ".", *list).empty());
  folder.write("maps/notes.txt", "mine");
  EXPECT_EQ(not_listed(folder / ".", *list), std::vector<std::string>{"maps/notes.txt"});

  remove_listed(folder / ".", "something else");
  EXPECT_TRUE(fs::exists(folder / "results.csv"));
  remove_listed(folder / ".", "results");
  EXPECT_FALSE(fs::exists(folder / "results.csv"));
  EXPECT_FALSE(fs::exists(folder / "maps/deep"));
  EXPECT_TRUE(fs::exists(folder / "maps/notes.txt"));
}

TEST(FileList, WhatIsNoListOrLeadsOutOfTheFolderIsNotFollowed) {
  const test::TemporaryFolder folder;
  EXPECT_FALSE(read_file_list(folder / "."));
  folder.write(kFileList, "somebody's notes\nresults.csv\n");
  EXPECT_FALSE(read_file_list(folder / "."));
  folder.write(kFileList, "genu results\n../thesis.tex\n/etc/passwd\na.csv\n");
  EXPECT_EQ(read_file_list(folder / ".")->files, std::set<std::string>{"a.csv"});
}

}  // namespace
}  // namespace genu
