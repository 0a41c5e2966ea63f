#include "genu/sweep/whole_file.h"

#include <sstream>

#include <gtest/gtest.h>

#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu {
namespace {

WholeFile seen(const std::string& text) {
  std::istringstream in(text);
  return look_through(in, [](std::uint64_t, std::string_view) {});
}

TEST(WholeFile, IsThereOnlyWithItsEnd) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "a";
  {
    WholeFileWriter file(path);
    file.write("head\none\n");
    file.write("two\n");
    EXPECT_FALSE(std::filesystem::exists(path));
    ASSERT_EQ(file.commit(7), "");
  }
  const std::string text = test::read_file(path);
  std::istringstream in(text);
  std::string lines;
  const WholeFile file =
      look_through(in, [&](std::uint64_t n, std::string_view line) { lines += std::to_string(n) + std::string(line); });
  EXPECT_EQ(lines, "0head1one2two");
  EXPECT_TRUE(file.whole);
  EXPECT_EQ(file.head, "head");
  EXPECT_EQ(file.lines, 3u);
  EXPECT_TRUE(file.ends_with(7));
  EXPECT_FALSE(file.ends_with(6));
  // Cut at any byte, with a byte changed, and with something behind it.
  for (std::size_t n = 0; n < text.size(); ++n) EXPECT_FALSE(seen(text.substr(0, n)).whole) << n;
  EXPECT_FALSE(seen(test::with_first(text, "two", "tow")).ends_with(7));
  EXPECT_FALSE(seen(text + "three\n").whole);
}

}  // namespace
}  // namespace genu
