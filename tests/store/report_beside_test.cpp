// A table beside a run: which column is which, in which unit, and what is refused with its place.
#include "genu/store/report_beside.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu {
namespace {

const std::vector<std::string> kKnown = {
    "step", "status", "time_s", "knee.flexion_deg", "knee.x_mm", "ACL.force_N", "knee.adduction_deg"};

struct Read {
  std::optional<ReportBeside> table;
  Diagnostics said;

  Read(const std::string& name, const std::string& text, const std::string& columns = {}) {
    const test::TemporaryFolder folder;
    table = read_beside(folder.write(name, text), columns, kKnown, said);
  }
  std::vector<double> of(const std::string& column) const {
    for (const auto& c : table->columns)
      if (c.column == column) return c.numbers;
    ADD_FAILURE() << "no column " << column;
    return {};
  }
  void refused(const std::string& words) const {
    EXPECT_FALSE(table.has_value());
    EXPECT_TRUE(test::contains(test::messages(said), words)) << test::messages(said);
  }
};

TEST(ReportBeside, NamesOfResultsWithAndWithoutTheirUnits) {
  const Read r("measured.csv", "knee.flexion_deg,ACL.force,other\n0,1,7\n10,2.5,7\n");
  ASSERT_TRUE(r.table) << test::messages(r.said);
  EXPECT_EQ(r.table->name, "measured.csv");
  EXPECT_EQ(r.table->columns.size(), 2u);
  EXPECT_EQ(r.of("knee.flexion_deg"), (std::vector<double>{0, 10}));
  EXPECT_EQ(r.of("ACL.force_N"), (std::vector<double>{1, 2.5}));
  EXPECT_TRUE(r.said.items().empty()) << test::messages(r.said);
}

TEST(ReportBeside, ColumnsAndUnitsOfTheUser) {
  const Read r("m.csv", "angle,shift,pull\n3.14159265358979,1.5,20\n",
               "knee.flexion=angle[rad], knee.x_mm = shift[cm], ACL.force_N=pull");
  ASSERT_TRUE(r.table) << test::messages(r.said);
  EXPECT_NEAR(r.of("knee.flexion_deg")[0], 180, 1e-9);
  EXPECT_NEAR(r.of("knee.x_mm")[0], 15, 1e-12);
  EXPECT_EQ(r.of("ACL.force_N")[0], 20);
}

/// As genu evaluate reads it: an angle in rad, a length in m. Forces have no such habit.
TEST(ReportBeside, ValuesWithoutAUnit) {
  const Read r("m.csv", "turn,knee.x,pull,flex_deg\n0.5,0.01,20,30\n",
               "knee.adduction=turn, ACL.force=pull, knee.flexion=flex_deg");
  ASSERT_TRUE(r.table) << test::messages(r.said);
  EXPECT_NEAR(r.of("knee.adduction_deg")[0], 0.5 * 180 / M_PI, 1e-12);
  EXPECT_NEAR(r.of("knee.x_mm")[0], 10, 1e-12);
  EXPECT_EQ(r.of("ACL.force_N")[0], 20);
  EXPECT_EQ(r.of("knee.flexion_deg")[0], 30);
  const std::string said = test::messages(r.said);
  EXPECT_TRUE(test::contains(said,
                             "m.csv:1:1: warning: turn: is read in rad, because it has no unit: say --columns "
                             "\"knee.adduction=turn[rad]\""))
      << said;
  EXPECT_TRUE(test::contains(said, "m.csv:1:6: warning: knee.x: is read in m")) << said;
  EXPECT_EQ(r.said.items().size(), 2u) << said;
}

TEST(ReportBeside, UnitsOfForces) {
  const Read r("m.csv", "knee.flexion_deg,pull,ACL.force [kN]\n0,2,3\n", "ACL.force=pull[kN]");
  ASSERT_TRUE(r.table) << test::messages(r.said);
  EXPECT_NEAR(r.of("ACL.force_N")[0], 2000, 1e-9);
  EXPECT_NEAR(Read("m.csv", "knee.flexion_deg,ACL.force [kN]\n0,3\n").of("ACL.force_N")[0], 3000, 1e-9);
  Read("m.csv", "knee.flexion_deg,pull\n0,2\n", "ACL.force=pull[potatoes]")
      .refused("m.csv:1:18: pull = \"potatoes\": is no unit of ACL.force_N: N, kN");
  Read("m.csv", "knee.flexion_deg,ACL.force [mm]\n0,2\n").refused("is no unit of ACL.force_N: N, kN");
}

TEST(ReportBeside, FilesOfOpenSimAreInTheirOwnUnits) {
  const std::string head = "name\nversion=1\nnRows=1\nnColumns=3\ninDegrees=no\nendheader\n";
  const Read r("m.mot", head + "time\tflex\ttx\n0\t0.5\t0.01\n", "knee.flexion=flex, knee.x=tx");
  ASSERT_TRUE(r.table) << test::messages(r.said);
  EXPECT_NEAR(r.of("knee.flexion_deg")[0], 0.5 * 180 / M_PI, 1e-12);
  EXPECT_NEAR(r.of("knee.x_mm")[0], 10, 1e-12);
  EXPECT_EQ(r.of("time_s")[0], 0);
}

TEST(ReportBeside, WhatWasNotMeasuredIsLeftOutAndCounted) {
  const Read r("m.csv", "knee.flexion_deg,knee.adduction_deg\n0,NaN\n10,\n20,3\n");
  ASSERT_TRUE(r.table) << test::messages(r.said);
  EXPECT_TRUE(std::isnan(r.of("knee.adduction_deg")[0]) && std::isnan(r.of("knee.adduction_deg")[1]));
  EXPECT_TRUE(test::contains(test::messages(r.said), "2 cells hold no number and are left out"))
      << test::messages(r.said);
}

TEST(ReportBeside, WhatIsRefused) {
  const std::string good = "knee.flexion_deg,a\n0,1\n";
  Read("m.csv", "knee.flexion_deg,knee.adduction_deg\n0,x1\n")
      .refused(":2:3: knee.adduction_deg = \"x1\": must be a number");
  Read("m.csv", "knee.flexion_deg,knee.adduction_deg\n0,1e99\n").refused("must be a number of at most 1e20");
  Read("m.csv", good).refused("has one column in common with results.csv");
  Read("m.csv", good, "knee.flexon=a").refused("did you mean \"knee.flexion\"?");
  Read("m.csv", good, "knee.x=b").refused("is no column of ");
  Read("m.csv", good, "knee.x").refused("must be COLUMN=NAME");
  Read("m.csv", good, "knee.x=a, knee.x_mm=a").refused("is given twice");
  Read("m.csv", good, "knee.x=a[deg]").refused("is no unit of knee.x_mm: mm, cm, m");
  Read("m.csv", "").refused("m.csv");
}

}  // namespace
}  // namespace genu
