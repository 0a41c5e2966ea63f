#include "genu/core/input_files.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace genu {
namespace {

TEST(InputFiles, KeepWhatTheyHaveReadFirst) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("a.txt", "one");
  InputFiles files;
  ASSERT_NE(files.bytes(path), nullptr);
  folder.write("a.txt", "another");
  EXPECT_EQ(*files.bytes(path), "one");
  ASSERT_TRUE(files.checksum(path));
  EXPECT_EQ(files.checksum(path)->bytes, 3u);
  EXPECT_EQ(files.checksum(path)->xxh128, checksum("one").xxh128);
}

TEST(InputFiles, KeepTheChecksumOfWhatWasReleased) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("a.txt", "one");
  InputFiles files;
  const auto bytes = files.bytes(path);
  files.release(path);
  EXPECT_EQ(files.bytes(path), nullptr);
  EXPECT_EQ(*bytes, "one");  // whoever holds them keeps them
  EXPECT_EQ(files.checksum(path)->xxh128, checksum("one").xxh128);
}

TEST(InputFiles, APathThatWasGivenItsBytesIsNotOpened) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("file.txt", "on disk");
  InputFiles files;
  files.put(path, "in memory");
  EXPECT_EQ(*files.bytes(path), "in memory");
  EXPECT_EQ(files.checksum(path)->xxh128, checksum("in memory").xxh128);
}

TEST(InputFiles, HaveNothingOfWhatIsNoRegularFile) {
  const test::TemporaryFolder folder;
  InputFiles files;
  for (const std::string& path : {folder / "missing", folder / "", std::string("/dev/zero")}) {
    EXPECT_EQ(files.bytes(path), nullptr) << path;
    EXPECT_FALSE(files.checksum(path)) << path;
  }
}

TEST(InputFiles, WhatWasSetAsideIsReadAgainUnlessItHasChanged) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("mesh.stl", "solid");
  InputFiles files;
  files.set_aside(path);  // nobody has asked for it yet
  ASSERT_TRUE(files.checksum(path));
  files.set_aside(path);
  ASSERT_TRUE(files.bytes(path));
  EXPECT_EQ(*files.bytes(path), "solid");
  files.set_aside(path);
  EXPECT_EQ(files.checksum(path)->xxh128, checksum("solid").xxh128);
  folder.write("mesh.stl", "other");
  EXPECT_FALSE(files.bytes(path));
  EXPECT_FALSE(files.bytes(path));
  EXPECT_EQ(files.checksum(path)->xxh128, checksum("solid").xxh128);
  InputFiles given;
  given.put(path, "in memory");
  given.set_aside(path);
  EXPECT_EQ(*given.bytes(path), "in memory");
  given.release(path);
  given.set_aside(path);
  EXPECT_FALSE(given.bytes(path)) << "released for good";
}

}  // namespace
}  // namespace genu
