// Whether the tables and charts of a study that stand in a knee's folder are those that it writes now.
#pragma once

#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "studies/solved_scene.h"

namespace genu::test {

/// The same words, and numbers that differ by no more than one unit of their last written decimal: a pose found by
/// other steps differs in digits that decide a rounding now and then.
inline bool same_up_to_rounding(const std::string& a, const std::string& b) {
  const char *i = a.data(), *j = b.data(), *i_end = i + a.size(), *j_end = j + b.size();
  while (i != i_end && j != j_end) {
    double x = 0, y = 0;
    const auto [after_x, no_x] = std::from_chars(i, i_end, x, std::chars_format::fixed);
    const auto [after_y, no_y] = std::from_chars(j, j_end, y, std::chars_format::fixed);
    if (no_x != std::errc() || no_y != std::errc()) {
      if (*i++ != *j++) return false;
      continue;
    }
    const std::string_view word(i, static_cast<std::size_t>(after_x - i));
    const std::size_t point = word.find('.');
    const double decimals = point == std::string_view::npos ? 0 : static_cast<double>(word.size() - point - 1);
    if (!(std::abs(x - y) <= 1.001 * std::pow(10, -decimals))) return false;
    i = after_x;
    j = after_y;
  }
  return i == i_end && j == j_end;
}

inline void expect_same_files(const std::string& folder, const studies::Files& files) {
  EXPECT_FALSE(files.empty());
  for (const auto& [name, text] : files) {
    std::ifstream in(folder + "/" + name, std::ios::binary);
    std::ostringstream found;
    found << in.rdbuf();
    EXPECT_TRUE(same_up_to_rounding(found.str(), text))
        << folder << "/" << name << " is out of date: run tools/figures";
  }
}

}  // namespace genu::test
