// A results.csv as written: names of columns, and a number, a word or nothing in each cell.
#pragma once

#include <atomic>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "genu/core/diagnostics.h"

namespace genu::judge {

class ResultsFile {
 public:
  /// Reads the text of a results.csv. Empty, with each mistake at its line and column in `out`, where a row is too
  /// short or too long, a name occurs twice, or a cell holds no finite number (columns `status` and `stability` hold
  /// words).
  [[nodiscard]] static std::optional<ResultsFile> parse(std::string_view bytes, const std::string& file,
                                                        Diagnostics& out);

  std::size_t rows() const { return numbers_.size(); }
  const std::vector<std::string>& columns() const { return columns_; }
  bool has(const std::string& column) const { return index_.contains(column); }
  /// NaN where the cell is empty or the column is missing.
  double number(std::size_t row, const std::string& column) const;
  const std::string& status(std::size_t row) const { return status_[row]; }
  /// Columns that no check has used.
  std::vector<std::string> unread() const;

 private:
  std::vector<std::string> columns_;
  std::unordered_map<std::string, std::size_t> index_;
  std::vector<std::vector<double>> numbers_;
  std::vector<std::string> status_;
  std::shared_ptr<std::atomic<bool>[]> read_;  // of each column; rows are judged by many threads
};

/// One row, as the checks read it.
struct Row {
  const ResultsFile* file = nullptr;
  std::size_t index = 0;
  double operator()(const std::string& column) const { return file->number(index, column); }
  bool has(const std::string& column) const { return file->has(column); }
};

}  // namespace genu::judge
