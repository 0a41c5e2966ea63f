#include "genu/store/report_rows.h"

#include <cmath>

#include <gtest/gtest.h>

#include "results/report_case.h"

namespace genu {
namespace {

/// 11 rows of two columns: the number of the row, and its square. With two poses, a contact and a curve a row has 24
/// numbers.
struct Long {
  test::ReportCase base;
  ResultTable table;
  ReportRun run;

  Long() {
    table.add_column("row");
    table.add_column("square");
    run = base.run();
    run.poses = &table;
    run.chart.x.clear();
    run.chart.panels = {{"Squares", {{"square", {}, {}}}, false, false}};
    run.chart.breaks = {4, 5};
    run.body_poses.clear();
    run.contacts.resize(1);
    for (int k = 0; k < 11; ++k) {
      table.add_row();
      table.set("row", static_cast<double>(k));
      table.set("square", static_cast<double>(k * k));
      run.chart.x.push_back(k);
      run.chart.panels[0].series[0].y.push_back(k * k);
      run.body_poses.emplace_back();
      run.contacts[0].point.emplace_back(k, 0, 0);
      run.contacts[0].force.emplace_back(0, k, 0);
    }
  }
};

TEST(ReportRows, AllStayWhereThereIsRoom) {
  Long c;
  EXPECT_TRUE(thin_rows(c.run, 11 * 24).empty());
  EXPECT_EQ(c.run.poses, &c.table);
  EXPECT_EQ(c.run.every, 1u);
}

TEST(ReportRows, EveryThirdAndTheLast) {
  Long c;
  EXPECT_EQ(thin_rows(c.run, 100), (std::vector<std::size_t>{0, 3, 6, 9, 10}));
  EXPECT_EQ(c.run.every, 3u);
  EXPECT_EQ(c.run.rows_in_full, 11u);
  ASSERT_EQ(c.run.poses->rows(), 5u);
  EXPECT_EQ(c.run.poses->number(2, "square"), 36);
  EXPECT_EQ(c.run.poses->number(4, "row"), 10);
  EXPECT_EQ(c.run.chart.x, (std::vector<double>{0, 3, 6, 9, 10}));
  EXPECT_EQ(c.run.chart.panels[0].series[0].y, (std::vector<double>{0, 9, 36, 81, 100}));
  EXPECT_EQ(c.run.chart.breaks, (std::vector<std::size_t>{2}));
  EXPECT_EQ(c.run.body_poses.size(), 5u);
  EXPECT_EQ(c.run.contacts[0].force[3].y(), 9);
}

}  // namespace
}  // namespace genu
