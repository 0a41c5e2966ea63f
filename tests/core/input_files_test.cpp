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

}  // namespace
}  // namespace genu
