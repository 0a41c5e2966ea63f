#include "genu/assemble/text_places.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(TextPlaces, NumbersAndNamesAreReplacedAndNothingElse) {
  TextPlaces places("a = 1.5  # one\nb = [2, 30]\nname = \"ACL\"\n");
  places.value({1, 5}, "7");
  places.value({2, 9}, "-4e3");
  places.value({1, 5}, "8");  // the first holds
  EXPECT_TRUE(places.word({3, 8}, "ACL", "PCL"));
  EXPECT_EQ(places.text(), "a = 7  # one\nb = [2, -4e3]\nname = \"PCL\"\n");
}

TEST(TextPlaces, ColumnsCountCharactersNotBytes) {
  TextPlaces places("\"Kreuzbänder\" = { k = 1 }\n");
  places.value({1, 23}, "2");
  EXPECT_EQ(places.text(), "\"Kreuzbänder\" = { k = 2 }\n");
}

TEST(TextPlaces, WhatIsNoNameInQuotesStays) {
  TextPlaces places("a = \"\"\"ACL\"\"\"\nb = 'ACL'\nc = \"ACL\"\n");
  EXPECT_FALSE(places.word({1, 5}, "ACL", "PCL")) << "three quotes";
  EXPECT_FALSE(places.word({2, 5}, "PCL", "ACL")) << "another name";
  EXPECT_FALSE(places.word({3, 5}, "ACL", "P\"CL")) << "would end the name";
  EXPECT_TRUE(places.word({2, 5}, "ACL", "PCL"));
  EXPECT_EQ(places.text(), "a = \"\"\"ACL\"\"\"\nb = 'PCL'\nc = \"ACL\"\n");
}

TEST(TextPlaces, TextsAndListsAreReplacedWhole) {
  TextPlaces places(
      "a = \"x\\\"y\" # a\nb = [ \"p]\", # ]\n  ['q'], 2 ] # b\nc = 'z'\nd = 3\ne = \"\"\"\nf\"\"\"\ng = [1,");
  EXPECT_TRUE(places.text_or_list({1, 5}, "'A'"));
  EXPECT_TRUE(places.text_or_list({2, 5}, "[]"));
  EXPECT_TRUE(places.text_or_list({4, 5}, "\"C\""));
  EXPECT_FALSE(places.text_or_list({5, 5}, "0")) << "a number";
  EXPECT_FALSE(places.text_or_list({6, 5}, "0")) << "three quotes";
  EXPECT_FALSE(places.text_or_list({8, 5}, "0")) << "no end";
  EXPECT_EQ(places.text(), "a = 'A' # a\nb = [] # b\nc = \"C\"\nd = 3\ne = \"\"\"\nf\"\"\"\ng = [1,");
}

TEST(TextPlaces, LinesGoBelowAHeaderAlsoInTheLastLine) {
  TextPlaces places("[a]\nx = 1\n  [b]");
  EXPECT_TRUE(places.line_below({1, 2}, "y = 2"));
  EXPECT_FALSE(places.line_below({2, 1}, "y = 2")) << "no header";
  EXPECT_TRUE(places.line_below({3, 4}, "z = 3"));
  EXPECT_EQ(places.text(), "[a]\ny = 2\nx = 1\n  [b]\nz = 3\n");
}

}  // namespace
}  // namespace genu
