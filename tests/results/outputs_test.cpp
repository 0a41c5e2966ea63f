#include "genu/results/outputs.h"

#include <set>

#include <gtest/gtest.h>

#include "support/solved.h"

namespace genu {
namespace {

TEST(Outputs, AreAllColumnsOfResultsOrSayWhyNot) {
  std::string text = test::knee("[combination.both]\nterms = { \"knee.flexion\" = 1, \"knee.adduction\" = 2 }\n" +
                                test::load("pull",
                                           "force = [0, 0, -1]\nscale = { over = \"knee.flexion\", table = "
                                           "[[0, 0], [90, 1]] }") +
                                "[[step]]\nprescribe = { \"both\" = [0, 10] }\nincrements = 1\n");
  const std::string pair = "surfaces = [\"torus_medial\", \"plane_medial\"]\n";
  text.insert(text.find(pair) + pair.size(), "regions = { front = \"y < 0\", back = \"y >= 0\" }\n");
  const auto s = test::scene_model(text);
  const auto steps = plan_steps(s.scene);
  PoseRecord record;  // two contacts have been seen
  record.point.pose.last_number.assign(s.model.pairs.size(), 2);
  const ResultTable table = pose_table(s.scene, s.model, steps, {record});
  std::vector<std::string> smooth, expected;
  for (const Output& o : outputs_of(s.scene, s.model, steps, 2)) {
    smooth.push_back(o.column);
    EXPECT_TRUE(why_not_smooth(o.column).empty()) << o.column;
    const std::string end = o.unit == "1" ? "" : "_" + o.unit;
    EXPECT_EQ(o.column.substr(o.column.size() - end.size()), end);
  }
  for (const std::string& column : table.columns())
    if (why_not_smooth(column).empty()) expected.push_back(column);
  EXPECT_EQ(smooth, expected);
  EXPECT_GT(smooth.size(), 60u);
  for (const char* column : {"step", "status", "medial.front.points", "stability.min_eigenvalue_Nmm", "residual"}) {
    EXPECT_TRUE(table.has_column(column)) << column;
    EXPECT_FALSE(why_not_smooth(column).empty()) << column;
  }
}

}  // namespace
}  // namespace genu
