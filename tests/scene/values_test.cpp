// Single numbers of a scene: rules, and what is 0 for all purposes.
#include "genu/scene/values.h"

#include "genu/core/units.h"
#include "scene/scene_text.h"

namespace genu::scene_test {
namespace {

struct Read {
  std::optional<double> value;
  std::string said;
};

Read read(const std::string& text, NumberRule rule) {
  Diagnostics out;
  Scene scene;
  ReadContext context("", out, scene);
  const auto document = parse_toml("n = " + text, "", out);
  Read read{read_number(context, Item{document->member("n"), "n"}, rule), {}};
  for (const Diagnostic& d : out.items()) read.said += d.rule;
  return read;
}

TEST(Values, ATinyNumberIsZeroWhereZeroIsAllowed) {
  const NumberRule any = plain_rule("N");
  for (const char* tiny : {"6e-42", "-6e-42", "1e-31", "0", "-0.0", "5e-324"}) {
    EXPECT_EQ(read(tiny, any).value, 0.0) << tiny << read(tiny, any).said;
    EXPECT_FALSE(std::signbit(read(tiny, any).value.value_or(-1))) << tiny;
  }
  EXPECT_EQ(read("-6e-42", non_negative(any)).value, 0.0);
  EXPECT_EQ(read("1e-29", any).value, 1e-29);
  NumberRule strain = any;
  strain.above = -1;
  EXPECT_EQ(read("6e-42", strain).value, 0.0);
  NumberRule in_mm = any;
  in_mm.unit = units::kMillimetre;
  EXPECT_EQ(read("1e-28", in_mm).value, 0.0);
}

TEST(Values, ATinyNumberIsRefusedWhereZeroIs) {
  const Read tiny = read("6e-42", positive(plain_rule("N")));
  EXPECT_FALSE(tiny.value);
  EXPECT_EQ(tiny.said, "is out of range: smaller than anything in a joint");
  EXPECT_EQ(read("0", positive(plain_rule("N"))).said, "must be > 0 N");
  EXPECT_EQ(read("-6e-29", non_negative(plain_rule("N"))).said, "must be >= 0 N");
}

}  // namespace
}  // namespace genu::scene_test
