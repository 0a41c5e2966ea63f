#include "genu/mesh_files/text_words.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(TextWords, KnowTheirLines) {
  TextWords words("a b # c\n\r\n d#e\n", '#');
  EXPECT_EQ(words.next(), "a");
  EXPECT_EQ(words.peek(), "b");
  EXPECT_EQ(words.next(), "b");
  EXPECT_EQ(words.line(), 1u);
  EXPECT_EQ(words.next(), "d#e");
  EXPECT_EQ(words.line(), 3u);
  EXPECT_EQ(words.next(), "");
  EXPECT_EQ(words.next(), "");
}

TEST(TextWords, LinesMayEndInAnyWay) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const std::string text = "title that is" + end + "a b" + end + end + "c \\" + end + "d" + end;
    TextWords words(text);
    words.next();
    words.skip_line();
    EXPECT_EQ(words.next(), "a");
    EXPECT_EQ(words.line(), 2u);
    EXPECT_EQ(words.next_in_line(), "b");
    EXPECT_EQ(words.next_in_line(), "");
    EXPECT_EQ(words.next(), "c");
    EXPECT_EQ(words.line(), 4u);
    EXPECT_EQ(words.next_in_line(), "d") << "joined by the backslash";
    EXPECT_EQ(words.next_in_line(), "");
    EXPECT_EQ(words.rest(), end);
  }
}

TEST(TextWords, NumbersAreWholeWords) {
  double x = 0;
  for (const char* good : {"1", "-1.5", "+2", ".5", "1e3", "1E-3", "1e-400"})
    EXPECT_TRUE(TextWords::number(good, x)) << good;
  for (const char* bad : {"", "1x", "x", "1e400", "--1", "1,5", "0x10"}) EXPECT_FALSE(TextWords::number(bad, x)) << bad;
  int i = 0;
  EXPECT_FALSE(TextWords::number("1.5", i));
  EXPECT_FALSE(TextWords::number("99999999999", i));
  EXPECT_TRUE(TextWords::number("-7", i));
  EXPECT_EQ(in_quotes("a\x1b[31m"), "\"a?[31m\"");
}

}  // namespace
}  // namespace genu
