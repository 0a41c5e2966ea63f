#include "genu/scene/toml_document.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(TomlDocument, KeepsOrderPlacesAndTypes) {
  Diagnostics out;
  const auto root = parse_toml("z = 1\na = [-2.5, \"t\\n\", true]\n[t.u]\n  k = { m = 1979-05-27 }\n", "f", out);
  ASSERT_TRUE(root);
  ASSERT_EQ(root->children.size(), 3u);
  EXPECT_EQ(root->children[0].key, "z") << "the order of the file, not of the alphabet";
  EXPECT_EQ(root->children[0].integer, 1);
  const TomlNode* a = root->member("a");
  ASSERT_TRUE(a);
  EXPECT_EQ(a->key_where.line, 2);
  EXPECT_EQ(a->key_where.column, 1);
  EXPECT_EQ(a->where.column, 5);
  EXPECT_EQ(a->children[1].where.column, 12);
  EXPECT_EQ(a->children[0].number, -2.5);
  EXPECT_EQ(literal(*a), "[-2.5, \"t\\n\", true]");
  const TomlNode* m = root->member("t")->member("u")->member("k")->member("m");
  EXPECT_EQ(m->kind, TomlNode::Kind::date);
  EXPECT_EQ(m->key_where.line, 4);
  EXPECT_EQ(m->key_where.column, 9);
  EXPECT_EQ(literal(*root), "a table");
  EXPECT_EQ(root->member("nothing"), nullptr);
}

TEST(TomlDocument, LiteralsAreShortAndReadBack) {
  Diagnostics out;
  const auto root = parse_toml("a = 3.0\nb = 0.1\nc = 1e300\nd = -inf\ne = nan\nf = \"" + std::string(99, 'x') +
                                   "\"\ng = [" + std::string(99, '1').replace(18, 1, ",").substr(0, 30) + "]\n",
                               "f", out);
  ASSERT_TRUE(root) << out.items().size();
  EXPECT_EQ(literal(*root->member("a")), "3.0");
  EXPECT_EQ(literal(*root->member("b")), "0.1");
  EXPECT_EQ(literal(*root->member("c")), "1e+300");
  EXPECT_EQ(literal(*root->member("d")), "-inf");
  EXPECT_EQ(literal(*root->member("e")), "nan");
  EXPECT_EQ(literal(*root->member("f")), "\"" + std::string(60, 'x') + "...\"");
}

TEST(TomlDocument, SyntaxErrorsHaveAPlace) {
  const auto refused = [](const std::string& text, int line, int column) {
    Diagnostics out;
    EXPECT_FALSE(parse_toml(text, "f", out)) << text;
    ASSERT_EQ(out.items().size(), 1u) << text;
    EXPECT_EQ(out.items()[0].line, line) << text << to_string(out.items()[0]);
    EXPECT_EQ(out.items()[0].column, column) << text << to_string(out.items()[0]);
    EXPECT_EQ(out.items()[0].rule.rfind("not valid TOML: ", 0), 0u) << out.items()[0].rule;
  };
  refused("[.", 1, 2);  // an assertion of toml++ aborts on this one unless it is compiled out
  refused("a = 1\na = 2\n", 2, 5);
  refused("[a]\n[b]\n[a]\n", 3, 1);
  refused("a = 1.5.5\n", 1, 8);
  refused("\n\na = [1, 2\n", 3, 11);
}

TEST(TomlDocument, LettersBesideAKeyAreRefusedOneByOne) {
  // toml++ looks for blanks there, in a table that forgot the letters between them.
  for (char32_t c = 0xa1; c < 0x800; ++c) {
    const std::string letter{static_cast<char>(0xc0 | (c >> 6)), static_cast<char>(0x80 | (c & 0x3f))};
    Diagnostics out;
    EXPECT_FALSE(parse_toml("a" + letter + " = 1\n", "t.toml", out)) << static_cast<unsigned>(c);
    ASSERT_EQ(out.items().size(), 1u);
    EXPECT_EQ(out.items()[0].line, 1);
    EXPECT_EQ(out.items()[0].column, 2);
  }
}

TEST(TomlDocument, DepthIsBounded) {
  std::string key = "a", nested = "b = ";
  for (int k = 0; k < 200000; ++k) key += ".a";
  for (int k = 0; k < 2000; ++k) nested += "[";
  Diagnostics out;
  EXPECT_FALSE(parse_toml("x = 1\n" + key + " = 1\n", "f", out));
  ASSERT_EQ(out.items().size(), 1u);
  EXPECT_EQ(to_string(out.items()[0]), "f:2:1: more than 250 dots in one key");
  EXPECT_FALSE(parse_toml(nested, "f", out));
  EXPECT_TRUE(parse_toml("# " + std::string(999, '.') + "\na = 1\n", "f", out)) << "comments may be dotted lines";
  EXPECT_TRUE(parse_toml("a" + key.substr(1, 400) + " = 1\n", "f", out)) << "deep, but harmless";
}

}  // namespace
}  // namespace genu
