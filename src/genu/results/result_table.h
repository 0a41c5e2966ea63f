// A table of results: named columns with units, one row a pose, written as CSV with 17 significant digits.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

namespace genu {

/// Empty, number or word.
using Cell = std::variant<std::monostate, double, long, std::string>;

class ResultTable {
 public:
  /// Adds a column on the right and returns its index.
  std::size_t add_column(const std::string& name);
  void add_row() { rows_.emplace_back(columns_.size()); }
  /// Sets a cell of the last row. A number that is not finite leaves the cell empty: no NaN is ever written.
  void set(std::size_t column, Cell value);
  /// Rows are mostly filled from left to right: the column after the last one found is looked at first.
  void set(std::string_view column, Cell value) {
    if (next_ >= columns_.size() || columns_[next_] != column) next_ = column_index(column);
    set(next_++, std::move(value));
  }

  /// Index of a column; throws std::out_of_range for a name that is none (a mistake in the program, not of its user).
  std::size_t column_index(std::string_view name) const { return index_.at(std::string(name)); }
  bool has_column(std::string_view name) const { return index_.count(std::string(name)) > 0; }
  const std::vector<std::string>& columns() const { return columns_; }
  std::size_t rows() const { return rows_.size(); }
  const Cell& at(std::size_t row, std::size_t column) const { return rows_[row][column]; }
  /// The number in a cell; NaN where it is empty or a word.
  double number(std::size_t row, std::string_view column) const;

  std::string to_csv() const;

 private:
  std::vector<std::string> columns_;
  std::unordered_map<std::string, std::size_t> index_;
  std::vector<std::vector<Cell>> rows_;
  std::size_t next_ = 0;  // the column after that of the last set() by name
};

/// Columns aligned for a terminal: numbers to the right with `digits` decimals, at most `most_rows` rows spread evenly.
std::string to_text(const ResultTable& table, const std::vector<std::string>& columns, int digits,
                    std::size_t most_rows);

}  // namespace genu
