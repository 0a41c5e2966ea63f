#include "genu/results/result_table.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(ResultTable, SeventeenDigitsGiveTheSameDoubleBack) {
  std::mt19937_64 generator(7);
  ResultTable table;
  table.add_column("x_mm");
  std::vector<double> values = {0.1, -0.0, 1.0 / 3, 5e-324, std::numeric_limits<double>::max(), 1e22, -2.5};
  while (values.size() < 2000) {
    const double v = std::bit_cast<double>(generator());
    if (std::isfinite(v)) values.push_back(v);
  }
  for (const double v : values) {
    table.add_row();
    table.set("x_mm", v);
  }
  std::istringstream csv(table.to_csv());
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "x_mm");
  for (const double v : values) {
    std::getline(csv, line);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(std::strtod(line.c_str(), nullptr)), std::bit_cast<std::uint64_t>(v))
        << line;
  }
}

TEST(ResultTable, WhatIsNoNumberIsAnEmptyCell) {
  ResultTable table;
  for (const char* name : {"a", "b", "c", "d"}) table.add_column(name);
  table.add_row();
  table.set("a", std::nan(""));
  table.set("b", std::numeric_limits<double>::infinity());
  table.set("d", 3L);
  EXPECT_EQ(table.to_csv(), "a,b,c,d\n,,,3\n");
  EXPECT_TRUE(std::isnan(table.number(0, "a")));
  EXPECT_EQ(table.number(0, "d"), 3);
}

TEST(ResultTable, WordsAreQuotedWhereCsvNeedsIt) {
  ResultTable table;
  for (const char* name : {"plain", "comma,", "quote\"", "line"}) table.add_column(name);
  table.add_row();
  table.set("plain", std::string("ok"));
  table.set("comma,", std::string("a,b"));
  table.set("quote\"", std::string("say \"a\""));
  table.set("line", std::string("a\nb"));
  EXPECT_EQ(table.to_csv(), "plain,\"comma,\",\"quote\"\"\",line\nok,\"a,b\",\"say \"\"a\"\"\",\"a\nb\"\n");
}

TEST(ResultTable, AColumnIsAddedOnceAndRowsGrowWithIt) {
  ResultTable table;
  EXPECT_EQ(table.add_column("a"), 0u);
  table.add_row();
  EXPECT_EQ(table.add_column("b"), 1u);
  EXPECT_EQ(table.add_column("a"), 0u);
  table.set("b", 2.0);
  EXPECT_EQ(table.to_csv(), "a,b\n,2\n");
  EXPECT_THROW(table.column_index("none"), std::out_of_range);
}

TEST(ResultTable, TheTerminalSeesFirstAndLastRow) {
  ResultTable table;
  table.add_column("x");
  for (int k = 0; k < 100; ++k) {
    table.add_row();
    table.set("x", static_cast<double>(k));
  }
  EXPECT_EQ(to_text(table, {"x"}, 1, 3), "     x\n   0.0\n  49.0\n  99.0\n");
  EXPECT_EQ(to_text(table, {"x"}, 1, 1), "    x\n  0.0\n");
}

}  // namespace
}  // namespace genu
