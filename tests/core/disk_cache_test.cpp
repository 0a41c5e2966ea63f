// What is kept is found as it was, or not at all.
#include "genu/core/disk_cache.h"

#include <chrono>
#include <fstream>

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  return files;
}

TEST(DiskCache, FindsWhatWasKeptUnderItsKeyAlone) {
  const test::TemporaryFolder folder;
  const DiskCache cache(folder / "cache");
  EXPECT_EQ(cache.find("knee"), std::nullopt);
  const std::string content("a\0b\n\xff", 5);
  cache.keep("knee", content);
  cache.keep("hip", "");
  EXPECT_EQ(cache.find("knee"), content);
  EXPECT_EQ(DiskCache(folder / "cache").find("hip"), "");
  EXPECT_EQ(cache.find("kne"), std::nullopt);
  cache.keep("knee", "another");
  EXPECT_EQ(cache.find("knee"), "another");
  EXPECT_EQ(fs::status(folder / "cache").permissions(), fs::perms::owner_all);
}

TEST(DiskCache, DamagedEntriesCountAsAbsent) {
  const test::TemporaryFolder folder;
  const DiskCache cache(folder / "cache");
  const std::string content(1000, 'x');
  cache.keep("knee", content);
  const fs::path file = files_in(folder / "cache").at(0);
  for (const std::uintmax_t size : {std::uintmax_t{1031}, std::uintmax_t{40}, std::uintmax_t{3}, std::uintmax_t{0}}) {
    fs::resize_file(file, size);
    EXPECT_EQ(cache.find("knee"), std::nullopt) << size;
  }
  cache.keep("knee", content);
  std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(500).put('y');
  EXPECT_EQ(cache.find("knee"), std::nullopt);
  cache.keep("knee", content);
  EXPECT_EQ(cache.find("knee"), content);
}

TEST(DiskCache, KeepsTheEntriesUsedLast) {
  const test::TemporaryFolder folder;
  const DiskCache cache(folder / "cache", 3500);  // three of 1032 bytes
  const std::string content(1000, 'x');
  for (const char* key : {"a", "b", "c"}) {
    cache.keep(key, content);
    for (const fs::path& file : files_in(folder / "cache"))  // each an hour older than the next
      fs::last_write_time(file, fs::last_write_time(file) - std::chrono::hours(1));
  }
  folder.write("cache/notes.txt", std::string(5000, 'n'));  // not the cache's to remove
  EXPECT_TRUE(cache.find("a"));                             // used last
  cache.keep("d", content);
  EXPECT_TRUE(cache.find("a"));
  EXPECT_FALSE(cache.find("b"));
  EXPECT_TRUE(cache.find("c"));
  EXPECT_TRUE(cache.find("d"));
  EXPECT_TRUE(fs::exists(folder / "cache/notes.txt"));
  cache.keep("large", std::string(4000, 'x'));
  EXPECT_FALSE(cache.find("large"));
  EXPECT_TRUE(cache.find("d"));
}

TEST(DiskCache, WhatCannotBeWrittenIsNotKept) {
  const test::TemporaryFolder folder;
  folder.write("file", "no folder");
  const DiskCache cache(folder / "file/cache");
  cache.keep("knee", "content");
  EXPECT_EQ(cache.find("knee"), std::nullopt);
}

TEST(DiskCache, AFolderThatOthersMayWriteToIsNotUsed) {
  const test::TemporaryFolder folder;
  const DiskCache cache(folder / "cache");
  cache.keep("knee", "content");
  fs::permissions(folder / "cache", fs::perms::group_write, fs::perm_options::add);
  EXPECT_EQ(cache.find("knee"), std::nullopt);
  cache.keep("hip", "content");
  EXPECT_EQ(files_in(folder / "cache").size(), 1u);
  fs::permissions(folder / "cache", fs::perms::owner_all);
  EXPECT_EQ(cache.find("knee"), "content");
  EXPECT_EQ(fs::status(files_in(folder / "cache").at(0)).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(DiskCache, IsOffUntilAProgramTurnsItOn) { EXPECT_EQ(user_cache(), nullptr); }

}  // namespace
}  // namespace genu
