#include "genu/results/storage_text.h"

#include <gtest/gtest.h>

#include "support/text.h"

namespace genu {
namespace {

TEST(StorageText, HasTheHeaderThatOpenSimReadsAndNumbersThatReadBack) {
  ResultTable table;
  for (const char* name : {"time", "knee_flex_r", "knee_tx_r"}) table.add_column(name);
  table.add_row();
  table.set("time", 0.0);
  table.set("knee_flex_r", 0.1 + 0.2);
  table.add_row();
  table.set("time", 1.0);
  table.set("knee_flex_r", -1e-7);
  table.set("knee_tx_r", 2.0);
  const std::string text = storage_text(table, "Coordinates", true);
  EXPECT_EQ(text.rfind("Coordinates\nversion=1\nnRows=2\nnColumns=3\ninDegrees=yes\n", 0), 0u);
  EXPECT_TRUE(
      test::contains(text, "\nendheader\ntime\tknee_flex_r\tknee_tx_r\n0\t0.30000000000000004\tnan\n1\t-1e-07\t2\n"));
  EXPECT_TRUE(test::contains(storage_text(table, "f", false), "inDegrees=no"));
}

}  // namespace
}  // namespace genu
