// Against the values that the authors of FNV publish (Fowler, Noll, Vo, Eastlake: The FNV Non-Cryptographic Hash
// Algorithm, IETF draft, test vectors of FNV-1a with 64 bits).
#include "genu/core/file_checksum.h"

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace genu {
namespace {

TEST(FileChecksum, IsThePublishedOne) {
  const test::TemporaryFolder folder;
  const std::pair<const char*, const char*> published[] = {
      {"", "cbf29ce484222325"}, {"a", "af63dc4c8601ec8c"}, {"foobar", "85944171f73967e8"}};
  for (const auto& [text, checksum] : published) {
    const auto found = file_checksum(folder.write("bytes", text));
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->fnv1a64, checksum) << text;
    EXPECT_EQ(found->bytes, std::string(text).size());
  }
}

TEST(FileChecksum, EveryByteCountsWhereverItStands) {
  const test::TemporaryFolder folder;
  std::string bytes(300000, '\0');
  const auto before = file_checksum(folder.write("bytes", bytes));
  for (const std::size_t place : {std::size_t{0}, std::size_t{65535}, std::size_t{65536}, bytes.size() - 1}) {
    std::string changed = bytes;
    changed[place] = '\xff';
    EXPECT_NE(file_checksum(folder.write("bytes", changed))->fnv1a64, before->fnv1a64) << place;
  }
  EXPECT_NE(file_checksum(folder.write("bytes", bytes + '\0'))->fnv1a64, before->fnv1a64);
}

TEST(FileChecksum, IsNoneWhereNothingCanBeRead) {
  const test::TemporaryFolder folder;
  EXPECT_FALSE(file_checksum(folder / "nothing").has_value());
  EXPECT_FALSE(file_checksum(folder / ".").has_value());
}

}  // namespace
}  // namespace genu
