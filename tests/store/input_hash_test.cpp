#include "genu/store/input_hash.h"

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace genu {
namespace {

TEST(InputHash, IsThatOfXxHashOf128Bits) {
  EXPECT_EQ(content_hash(""), "99aa06d3014798d86001c324468d497f");  // xxhsum -H2 of an empty file
  EXPECT_NE(content_hash("a"), content_hash("b"));
}

TEST(InputHash, OfAFileIsThatOfItsContent) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(file_hash(folder.write("a", "knee")), content_hash("knee"));
  EXPECT_EQ(file_hash(folder / "missing"), "");
}

TEST(InputHash, OfTheProgramStaysTheSame) {
  EXPECT_EQ(program_hash().size(), 32u);
  EXPECT_EQ(program_hash(), program_hash());
}

}  // namespace
}  // namespace genu
