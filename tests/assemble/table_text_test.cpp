// Encodings, lines, cells and decimal commas of tables.
#include "genu/assemble/table_text.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(TableText, WhatIsNoTextIsNamed) {
  using std::string_view;
  EXPECT_FALSE(fault_of_encoding("time,a\n0,1\n"));
  EXPECT_FALSE(fault_of_encoding("\xEF\xBB\xBFtime,\xC2\xB0\n"));
  EXPECT_FALSE(fault_of_encoding(""));
  for (const string_view utf16 : {string_view("\xFF\xFEt\0", 4), string_view("\xFE\xFF\0t", 4),
                                  string_view("t\0i\0m\0e\0", 8), string_view("\0t\0i\0m\0e", 8)}) {
    ASSERT_TRUE(fault_of_encoding(utf16));
    EXPECT_EQ(fault_of_encoding(utf16)->code, Code::not_utf8);
  }
  EXPECT_EQ(fault_of_encoding(string_view("abc\0\0\0\0d", 8))->code, Code::broken_file);
}

TEST(TableText, LinesEndInAnyWay) {
  const auto lines = lines_of("\xEF\xBB\xBFone\r\ntwo\rthree\n\n \t\nfour");
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0].text, "one");
  EXPECT_EQ(lines[1].text, "two");
  EXPECT_EQ(lines[2].text, "three");
  EXPECT_EQ(lines[3].text, "four");
  EXPECT_EQ(lines[3].number, 6);
}

TEST(TableText, TheSeparatorCutsNamesAndNumbersAlike) {
  EXPECT_EQ(separator_of("a,b", "1,2"), ',');
  EXPECT_EQ(separator_of("a;b", "1,0;2,0"), ';');
  EXPECT_EQ(separator_of("a\tb", "1,0\t2,0"), '\t');
  EXPECT_EQ(separator_of("a;angle (x, y)", "1,0;2"), ';');
  EXPECT_EQ(separator_of("a b", "1 2"), ' ');
  EXPECT_EQ(separator_of("knee angle", "1"), ',');
  EXPECT_EQ(separator_of("a,b", ""), ',');
  EXPECT_EQ(separator_of("a", "1"), ',');
}

TEST(TableText, DecimalCommas) {
  for (const char* word : {"0,5", "-5,25", "+1,5e-3", ",5"}) EXPECT_TRUE(has_decimal_comma(word)) << word;
  for (const char* word : {"0.5", "1,234.5", "1,2,3", "a,b", ",", "", "5"})
    EXPECT_FALSE(has_decimal_comma(word)) << word;
}

}  // namespace
}  // namespace genu
