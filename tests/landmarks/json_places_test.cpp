#include "genu/landmarks/json_places.h"

#include <gtest/gtest.h>

#include "genu/landmarks/tolerances.h"
#include "support/scenes.h"
#include "support/text.h"

namespace genu {
namespace {

TEST(JsonPlaces, KnowsWhereEachValueBegins) {
  Diagnostics out;
  const auto root = read_json(
      "a.json", "{\n  \"a\": [1, -2.5e3,\n   true],\n  \"b, {\": { \"\xc3\xa9\\\"\" : null, \"d\": \"x\\\\\" }\n}\n",
      out);
  ASSERT_TRUE(root) << test::messages(out);
  const JsonValue *a = root->find("a"), *b = root->find("b, {");
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->children.size(), 3u);
  EXPECT_EQ(a->at, (SourceLocation{2, 8}));
  EXPECT_EQ(a->children[1].at, (SourceLocation{2, 12}));
  EXPECT_EQ(a->children[1].number, -2500);
  EXPECT_EQ(a->children[1].text, "-2.5e3");
  EXPECT_EQ(a->children[2].at, (SourceLocation{3, 4}));
  EXPECT_EQ(b->children[0].at, (SourceLocation{4, 21}));  // in characters: e with an accent is one
  EXPECT_EQ(b->children[1].text, "x\\");
  EXPECT_EQ(b->children[1].at, (SourceLocation{4, 32}));
  EXPECT_EQ(a->find("a"), nullptr);
}

TEST(JsonPlaces, SaysWhereItEnds) {
  const std::pair<const char*, const char*> broken[] = {{"{\"a\": 1,\n \"b\" 2}", "a.json:2:6: "},
                                                        {"", "a.json:1:1: "},
                                                        {"{\"a\": [1, 2", "a.json:1:12: "},
                                                        {"nan", "a.json:1:"}};
  for (const auto& [text, said] : broken) {
    Diagnostics out;
    EXPECT_FALSE(read_json("a.json", text, out)) << text;
    ASSERT_EQ(out.items().size(), 1u) << text;
    EXPECT_TRUE(test::contains(to_string(out.items().front()), said)) << to_string(out.items().front());
    EXPECT_TRUE(test::contains(to_string(out.items().front()), "no JSON"));
  }
}

TEST(JsonPlaces, IsNotNestedWithoutEnd) {
  Diagnostics out;
  EXPECT_TRUE(read_json("a.json", std::string(kMostNested, '[') + std::string(kMostNested, ']'), out));
  EXPECT_TRUE(out.items().empty());
  EXPECT_FALSE(read_json("a.json", std::string(100000, '['), out));
  ASSERT_EQ(out.items().size(), 1u);
  EXPECT_TRUE(test::contains(to_string(out.items().front()), "nested more than 64 deep"));
}

}  // namespace
}  // namespace genu
