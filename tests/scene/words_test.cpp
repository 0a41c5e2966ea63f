#include "genu/scene/words.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(Words, Names) {
  for (const char* good : {"a", "_", "MCLd1", "post-lateral", "x_2"}) EXPECT_TRUE(is_name(good)) << good;
  for (const char* bad : {"", "1a", "-a", "a b", "a.b", "é", "a\n"}) EXPECT_FALSE(is_name(bad)) << bad;
}

TEST(Words, SuggestsTheNearest) {
  const std::vector<std::string> known = {"stiffness", "slack_length", "law"};
  EXPECT_EQ(did_you_mean("stifness", known), "; did you mean \"stiffness\"?");
  EXPECT_EQ(did_you_mean("STIFFNESS", known), "; did you mean \"stiffness\"?");
  EXPECT_EQ(did_you_mean("lwa", {"law", "lw"}), "; did you mean \"law\"?")
      << "the first: two letters swapped, or one too many";
  EXPECT_EQ(did_you_mean("rnu", {"explain", "new", "run"}), "; did you mean \"run\"?");
  EXPECT_EQ(did_you_mean("Chcek", {"check", "checkpoint"}), "; did you mean \"check\"?");
  EXPECT_EQ(did_you_mean("Lax", {"run", "laxity"}), "; did you mean \"laxity\"?") << "its beginning";
  EXPECT_EQ(did_you_mean("la", {"run", "laxity"}), "") << "too short to mean anything";
  EXPECT_EQ(did_you_mean("mass", known), "");
  EXPECT_EQ(did_you_mean("", known), "");
  EXPECT_EQ(did_you_mean("q", {"x", "y"}), "") << "a wholly different word is no suggestion";
  EXPECT_EQ(did_you_mean(std::string(100000, 'a'), known), "");
}

TEST(Words, Lists) {
  EXPECT_EQ(quoted_list({"a", "b"}), "\"a\", \"b\"");
  EXPECT_EQ(quoted_list({}), "");
}

TEST(Words, PatternsMatchWords) {
  for (const auto& [pattern, word] : {std::pair{"AAC.stiffness", "AAC.stiffness"},
                                      {"*", ""},
                                      {"*.stiffness", "AAC.stiffness"},
                                      {"A*C.*.?", "AAC.from.x"},
                                      {"**x", "x"},
                                      {"*a*b*", "xaybzb"},
                                      {"?", "x"}})
    EXPECT_TRUE(matches(pattern, word)) << pattern << " " << word;
  for (const auto& [pattern, word] : {std::pair{"AAC", "AAC.stiffness"},
                                      {"", "x"},
                                      {"?", ""},
                                      {"*.x", "from.y"},
                                      {"A*C", "AB"},
                                      {"aac*", "AAC"},
                                      {"*a*b", "ba"}})
    EXPECT_FALSE(matches(pattern, word)) << pattern << " " << word;
  EXPECT_FALSE(matches("*a*a*a*a*a*a*a*a*b", std::string(5000, 'a')));  // no exponential search
}

}  // namespace
}  // namespace genu
