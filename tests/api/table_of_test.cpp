#include "genu/api/table_of.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/api/problem.h"

namespace genu::api {
namespace {

ResultTable some_cells() {
  ResultTable table;
  for (const char* name : {"angle_deg", "count", "status"}) table.add_column(name);
  table.add_row();
  table.set("angle_deg", 0.1);
  table.set("count", 3L);
  table.set("status", std::string("ok"));
  table.add_row();
  table.set("count", 4L);
  return table;
}

TEST(TableOf, HasTheCellsOfTheTable) {
  const Table table = table_of(some_cells());
  EXPECT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.columns(), some_cells().columns());
  EXPECT_EQ(table.csv(), some_cells().to_csv());
  const auto angles = table.numbers("angle_deg"), counts = table.numbers("count");
  EXPECT_EQ(angles[0], 0.1);
  EXPECT_TRUE(std::isnan(angles[1])) << "an empty cell";
  EXPECT_EQ(counts[1], 4);
  EXPECT_EQ(table.words("status"), (std::vector<std::string>{"ok", ""}));
}

TEST(TableOf, WordsAreNoNumbersAndUnknownColumnsAreNamed) {
  const Table table = table_of(some_cells());
  EXPECT_TRUE(table.has_words("status"));
  EXPECT_THROW(table.numbers("status"), SceneError);
  EXPECT_FALSE(table.has("angle"));
  EXPECT_THROW(table.numbers("angle"), SceneError);
}

TEST(TableOf, ASharedTableIsNotCopied) {
  const auto shared = std::make_shared<const ResultTable>(some_cells());
  const Table table = table_of(shared);
  EXPECT_EQ(&table.columns(), &shared->columns());
}

}  // namespace
}  // namespace genu::api
