#include "genu/osim/xml_tree.h"

#include <gtest/gtest.h>

#include "genu/osim/tolerances.h"

namespace genu::osim {
namespace {

std::optional<XmlElement> parsed(const std::string& text, Diagnostics& out) { return parse_xml(text, "m.osim", out); }

TEST(XmlTree, HasTagsNamesTextAndPlaces) {
  Diagnostics out;
  const auto root = parsed(
      "\xef\xbb\xbf<?xml version=\"1.0\"?>\n<!-- a & b -->\n<A Version='4'>\n  <B name=\"b1\"> 1 2 &amp; 3\n</B>"
      "<objects/></A>\n",
      out);
  ASSERT_TRUE(root.has_value()) << to_string(out.items().front());
  EXPECT_EQ(root->tag, "A");
  EXPECT_EQ(root->attribute("Version"), "4");
  EXPECT_EQ(root->where, (SourceLocation{3, 1}));
  const XmlElement* b = root->child("B");
  ASSERT_NE(b, nullptr);
  EXPECT_EQ(b->name(), "b1");
  EXPECT_EQ(b->text, "1 2 & 3");
  EXPECT_EQ(b->where, (SourceLocation{4, 3}));
  EXPECT_EQ(root->child("C"), nullptr);
  EXPECT_EQ(root->objects_of("B"), nullptr);
}

struct Refused {
  const char* text;
  const char* message;
};

TEST(XmlTree, RefusesWhatIsNotWellFormedWithItsPlace) {
  for (const Refused& r :
       {Refused{"<a>\n  <b>\n</a>", "m.osim:3:"},
        Refused{"<a>\n <b>x & y</b></a>", "m.osim:2:7: is no well-formed XML: a & that begins no"},
        Refused{"<a>\n <b>x &lol; y</b></a>", "m.osim:2:7:"}, Refused{"<a/><b/>", "a second root element"},
        Refused{"", "is no well-formed XML"}, Refused{"<a name='1' name='2'/>", "has the attribute \"name\" twice"},
        Refused{"<a>\xff</a>", "m.osim:1:4: is no UTF-8"}, Refused{"<a>", "m.osim:1:"}}) {
    Diagnostics out;
    EXPECT_FALSE(parsed(r.text, out).has_value()) << r.text;
    ASSERT_EQ(out.items().size(), 1u) << r.text;
    EXPECT_NE(to_string(out.items()[0]).find(r.message), std::string::npos) << to_string(out.items()[0]);
  }
}

TEST(XmlTree, RefusesEntitiesBeforeTheyGrow) {
  Diagnostics out;
  const std::string bomb =
      "<?xml version=\"1.0\"?>\n<!DOCTYPE a [<!ENTITY l \"lol\"><!ENTITY m \"&l;&l;\">]>\n<a>&m;</a>";
  EXPECT_FALSE(parsed(bomb, out).has_value());
  ASSERT_EQ(out.items().size(), 1u);
  EXPECT_EQ(out.items()[0].line, 2);
  EXPECT_NE(out.items()[0].rule.find("document type"), std::string::npos);
}

std::string nested(int depth) {
  std::string text;
  for (int k = 0; k < depth; ++k) text += "<a>";
  for (int k = 0; k < depth; ++k) text += "</a>";
  return text;
}

TEST(XmlTree, RefusesDepthWithoutEnd) {
  Diagnostics fine, deep;
  EXPECT_TRUE(parsed(nested(kMaxDepth), fine).has_value());
  EXPECT_FALSE(parsed(nested(1'000'000), deep).has_value());
  ASSERT_EQ(deep.items().size(), 1u);
  EXPECT_EQ(deep.items()[0].code, Code::too_large);
  EXPECT_EQ(deep.items()[0].column, 3 * kMaxDepth + 1);
}

}  // namespace
}  // namespace genu::osim
