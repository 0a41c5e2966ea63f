// What is expected of a hard case is read whole, or refused with everything that is wrong with it.
#include "hard_cases/hard_case.h"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace genu {
namespace {

const std::string kExpectation = R"(why = "it is hard"
source = "by hand"
safeguard = "merging"
exit_code = 3
status = { ok = 5, over_edge = 1 }
events = { contact_lost = 1 }
says = ["one", "two"]
says_not = ["three"]
starts = 8
limit = 5

[[value]]
column = "j.x_mm"
row = -1
is = "1 + [j.y_mm]"
tolerance = 1e-9

[[value]]
event = "contact_lost"
column = "t"
is = 0.5
tolerance = 0.1

[[value]]
column = "stability"
word = "stable"

[[mesh]]
file = "ball.stl"
shape = "ball"
edge = 2
damage = [{ kind = "fin", near = [0, 0, 20], size = 4 }, { kind = "scale", size = 2 }]
)";

/// A catalogue of the family "a", with a patch for the safeguard "merging".
void lay_out_catalogue(const test::TemporaryFolder& folder) {
  for (const char* part : {"a", "mutants"}) std::filesystem::create_directory(folder / part);
  folder.write("mutants/merging.patch", "");
}

TEST(ReadHardCase, AllThatIsExpected) {
  const test::TemporaryFolder folder;
  lay_out_catalogue(folder);
  Diagnostics out;
  const auto e = read_expectation(folder.write("a/a.expect.toml", kExpectation), out);
  ASSERT_TRUE(e) << (out.items().empty() ? "" : to_string(out.items().front()));
  EXPECT_EQ(e->safeguard, "merging");
  EXPECT_EQ(e->exit_code, 3);
  EXPECT_EQ(e->statuses.size(), 2u);
  EXPECT_EQ(e->events.front().first, "contact_lost");
  EXPECT_EQ(e->says.size(), 2u);
  EXPECT_EQ(e->says_not.size(), 1u);
  EXPECT_EQ(e->starts, 8);
  EXPECT_EQ(e->limit, 5);
  ASSERT_EQ(e->values.size(), 3u);
  EXPECT_EQ(e->values[0].row, -1);
  EXPECT_EQ(e->values[0].value, "1 + [j.y_mm]");
  EXPECT_EQ(e->values[1].table, ExpectedValue::Table::events);
  EXPECT_EQ(e->values[1].value, "(0.5)");
  EXPECT_TRUE(e->values[2].is_word);
  ASSERT_EQ(e->meshes.size(), 1u);
  ASSERT_EQ(e->meshes[0].damage.size(), 2u);
  EXPECT_EQ(e->meshes[0].damage[0].near, Vec3(0, 0, 0.02));
  EXPECT_EQ(e->meshes[0].damage[1].size, 2);
}

TEST(ReadHardCase, EverythingThatIsWrongAtOnce) {
  const test::TemporaryFolder folder;
  lay_out_catalogue(folder);
  Diagnostics out;
  EXPECT_FALSE(read_expectation(
      folder.write("a/a.expect.toml", "why = \"x\"\nexit_code = 7\nsafeguard = \"belt\"\nsaid = 1\n"), out));
  std::string all;
  for (const Diagnostic& d : out.items()) all += to_string(d) + "\n";
  for (const char* piece :
       {"exit_code = 7", "safeguard = \"belt\"", "mutants/belt.patch is missing", "said", "nothing is expected"})
    EXPECT_NE(all.find(piece), std::string::npos) << piece << " is missing in\n" << all;
}

TEST(ReadHardCase, NumbersNeedASourceAndACaseASafeguard) {
  const test::TemporaryFolder folder;
  Diagnostics out;
  EXPECT_FALSE(read_expectation(
      folder.write("a.expect.toml", "why = \"x\"\nexit_code = 0\n[[value]]\ncolumn = \"a\"\nis = 1\ntolerance = 0\n"),
      out));
  EXPECT_EQ(out.items().size(), 2u);
}

TEST(ReadHardCase, CasesAreFoundByFamilyAndName) {
  const test::TemporaryFolder folder;
  lay_out_catalogue(folder);
  std::filesystem::create_directory(folder / "b");
  for (const char* name : {"b/two", "b/one", "a/three"}) {
    folder.write(std::string(name) + ".toml", "format = 1\n");
    folder.write(std::string(name) + ".expect.toml", kExpectation);
  }
  folder.write("shapes.toml", "");
  Diagnostics out;
  const auto cases = find_hard_cases(folder / ".", out);
  EXPECT_FALSE(out.has_errors());
  ASSERT_EQ(cases.size(), 3u);
  EXPECT_EQ(cases[0].name, "three");
  EXPECT_EQ(cases[1].name, "one");
  EXPECT_EQ(cases[2].family, "b");
  folder.write("a/alone.toml", "format = 1\n");
  find_hard_cases(folder / ".", out);
  EXPECT_TRUE(out.has_errors()) << "a scene without an expectation";
}

}  // namespace
}  // namespace genu
