#include "genu/core/diagnostics.h"

#include <type_traits>

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(Diagnostics, OneLineEach) {
  Diagnostic d =
      error_at({"scene.toml", {41, 13}}, Code::out_of_range, "ligament.AAC.stiffness", "-2", "must be > 0 N");
  EXPECT_EQ(to_string(d), "scene.toml:41:13: ligament.AAC.stiffness = -2: must be > 0 N");
  d.found.clear();
  EXPECT_EQ(to_string(d), "scene.toml:41:13: ligament.AAC.stiffness: must be > 0 N");
  d.column = 0;
  EXPECT_EQ(to_string(d), "scene.toml:41: ligament.AAC.stiffness: must be > 0 N");
  d.line = 0;
  d.key.clear();
  EXPECT_EQ(to_string(d), "scene.toml: must be > 0 N");
  d.severity = Diagnostic::Severity::warning;
  EXPECT_EQ(to_string(d), "scene.toml: warning: must be > 0 N");
  d.file.clear();
  EXPECT_EQ(to_string(d), "warning: must be > 0 N");
}

TEST(Diagnostics, WarningsAreNoErrors) {
  Diagnostics out;
  EXPECT_FALSE(out.has_errors());
  out.warning(Code::mesh_repaired, "f", "w");
  EXPECT_FALSE(out.has_errors());
  out.error(Code::no_such_file, "f", "no such file");
  EXPECT_TRUE(out.has_errors());
  EXPECT_EQ(out.count(Diagnostic::Severity::error), 1u);
  EXPECT_EQ(out.count(Diagnostic::Severity::warning), 1u);
  EXPECT_EQ(to_string(out.items()[1]), "f: no such file");
}

TEST(Diagnostics, HaveACodeHoweverTheyAreMade) {
  static_assert(!std::is_default_constructible_v<Diagnostic>);
  Diagnostics out;
  out.error(Code::no_such_file, "f", "is not there");
  out.warning(Code::mesh_flawed, "m", "has flaws");
  out.add(warning_at({"f", {2, 3}}, Code::no_effect, "k", "v", "r"));
  EXPECT_EQ(out.items()[0].code, Code::no_such_file);
  EXPECT_EQ(out.items()[1].code, Code::mesh_flawed);
  EXPECT_EQ(out.items()[2].code, Code::no_effect);
  EXPECT_EQ(to_string(out.items()[2]), "f:2:3: warning: k = v: r");
}

TEST(Diagnostics, SortedByPlaceAndStable) {
  Diagnostics out;
  const auto add = [&](const char* file, int line, int column, const char* rule) {
    out.add(error_at({file, {line, column}}, Code::wrong_form, {}, {}, rule));
  };
  add("b", 1, 1, "6");
  add("a", 10, 1, "5");
  add("a", 2, 9, "3");
  add("a", 2, 9, "4");
  add("a", 2, 8, "2");
  add("a", 0, 0, "1");
  out.sort();
  std::string order;
  for (const Diagnostic& d : out.items()) order += d.rule;
  EXPECT_EQ(order, "123456");
}

}  // namespace
}  // namespace genu
