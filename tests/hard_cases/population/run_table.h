// The columns of a results.csv that the population looks at.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace genu::population {

struct RunTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  bool has(const std::string& column) const { return index_.contains(column); }
  const std::string& text(std::size_t row, const std::string& column) const { return rows[row][index_.at(column)]; }
  double number(std::size_t row, const std::string& column) const { return std::stod(text(row, column)); }

  /// Empty where there is no such file.
  static RunTable read(const std::string& path);

 private:
  std::map<std::string, std::size_t> index_;
};

}  // namespace genu::population
