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

TEST(TextWords, DecimalCommasAreReadAndNoted) {
  const TextWords words("");
  MeshNotes notes;
  double x = 0;
  const std::pair<const char*, double> good[] = {
      {"1.5", 1.5}, {"-1,5", -1.5}, {",5", 0.5}, {"+2,5e-1", 0.25}, {"7", 7}};
  for (const auto& [word, value] : good) {
    EXPECT_TRUE(words.decimal(word, x, notes)) << word;
    EXPECT_EQ(x, value);
  }
  for (const char* bad : {"", ",", "1,", "1,2,3", "1.000,5", "1,000.5", "1,x"})
    EXPECT_FALSE(words.decimal(bad, x, notes)) << bad;
  EXPECT_EQ(notes.texts(),
            std::vector<std::string>{"has decimal commas in line 1 and 2 others: read as decimal points"});
}

TEST(TextWords, AByteOrderMarkIsNoWord) {
  TextWords words(
      "\xef\xbb\xbf"
      "a b",
      0, 5);
  EXPECT_EQ(words.next(), "a");
  EXPECT_EQ(words.line(), 5u);
}

TEST(TextWords, TellWhatStandsAtTheEnd) {
  const auto end = [](const std::string& text) {
    TextWords words(text, '#');
    MeshNotes notes;
    for (const std::string_view last = "last"; words.next() != last;) {
    }
    words.note_end(notes);
    return notes.texts().empty() ? std::string() : notes.texts()[0];
  };
  for (const char* whole : {"a last\n", "a last ", "last # no number", "last\n\n # 7"})
    EXPECT_EQ(end(whole), "") << whole;
  EXPECT_NE(end("a\nlast").find("no line end"), std::string::npos);
  EXPECT_NE(end("a last\nmore").find("\"more\" after all that its header promises in line 2"), std::string::npos);
}

}  // namespace
}  // namespace genu
