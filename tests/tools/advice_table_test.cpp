#include "cli/advice_table.h"

#include <set>

#include <gtest/gtest.h>

namespace genu::cli {
namespace {

TEST(AdviceTable, WhatIsCorrectedWhereTheErrorPointsToHasNoAdviceOfItsOwn) {
  for (const Code code : {Code::unknown_key, Code::missing_key, Code::wrong_form, Code::out_of_range,
                          Code::unknown_name, Code::duplicate, Code::conflict, Code::usage})
    EXPECT_EQ(advice_on_code(code), "") << to_string(code);
}

TEST(AdviceTable, TellsCodesApart) {
  std::set<std::string> told;
  for (const Code code : kAllCodes) {
    const std::string advice = advice_on_code(code);
    EXPECT_TRUE(advice.empty() || told.insert(advice).second) << to_string(code) << ": one code is enough";
  }
  EXPECT_GT(told.size(), 20u);
  EXPECT_EQ(advice_on_code(Code::not_utf8), "save the file as UTF-8 text");
}

}  // namespace
}  // namespace genu::cli
