#include "genu/scene/utf8.h"

#include <string>

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(Utf8, ValidText) {
  for (const std::string good :
       {"", "a\tb\r\n", "\xc3\xa9", "\xe2\x82\xac", "\xf0\x9f\xa6\xb5", "\xed\x9f\xbf", "\xf4\x8f\xbf\xbf"}) {
    EXPECT_FALSE(first_invalid_utf8(good)) << good;
  }
}

TEST(Utf8, InvalidTextAndItsPlace) {
  // Stray continuation, cut off, overlong, surrogate, past the end of Unicode, NUL, the mark of UTF-16.
  for (const std::string& bad : {std::string("\x80"), std::string("\xc3"), std::string("\xe2\x82"),
                                 std::string("\xc0\xaf"), std::string("\xe0\x80\x80"), std::string("\xed\xa0\x80"),
                                 std::string("\xf4\x90\x80\x80"), std::string(1, '\0'), std::string("\xff\xfe")}) {
    const auto where = first_invalid_utf8("\xc3\xa9\n\xc3\xa9z" + bad);
    ASSERT_TRUE(where);
    EXPECT_EQ(where->line, 2);
    EXPECT_EQ(where->column, 3) << "counted in characters";
  }
}

}  // namespace
}  // namespace genu
