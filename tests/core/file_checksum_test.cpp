// Against what xxHash's own program prints: printf TEXT | xxhsum -H2.
#include "genu/core/file_checksum.h"

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace genu {
namespace {

TEST(FileChecksum, IsWhatXxhsumPrints) {
  const test::TemporaryFolder folder;
  const std::pair<const char*, const char*> printed[] = {{"", "99aa06d3014798d86001c324468d497f"},
                                                         {"a", "a96faf705af16834e6c632b61e964e1f"},
                                                         {"abc", "06b05ab6733a618578af5f94892f3950"}};
  for (const auto& [text, sum] : printed) {
    const auto found = file_checksum(folder.write("bytes", text));
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->xxh128, sum) << text;
    EXPECT_EQ(found->bytes, std::string(text).size());
    EXPECT_EQ(checksum(text).xxh128, sum) << "in memory";
  }
}

TEST(FileChecksum, EveryByteCountsWhereverItStands) {
  const test::TemporaryFolder folder;
  std::string bytes(300000, '\0');
  const auto before = file_checksum(folder.write("bytes", bytes));
  for (const std::size_t place : {std::size_t{0}, std::size_t{65535}, std::size_t{65536}, bytes.size() - 1}) {
    std::string changed = bytes;
    changed[place] = '\xff';
    EXPECT_NE(file_checksum(folder.write("bytes", changed))->xxh128, before->xxh128) << place;
  }
  EXPECT_NE(file_checksum(folder.write("bytes", bytes + '\0'))->xxh128, before->xxh128);
}

TEST(FileChecksum, IsNoneWhereNothingCanBeRead) {
  const test::TemporaryFolder folder;
  EXPECT_FALSE(file_checksum(folder / "nothing").has_value());
  EXPECT_FALSE(file_checksum(folder / ".").has_value());
}

}  // namespace
}  // namespace genu
