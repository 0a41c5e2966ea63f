// Results as columns.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace genu::api {

/// A table whose columns are numbers or words. Copies share it; it never changes.
class Table {
 public:
  Table();

  std::size_t rows() const;
  const std::vector<std::string>& columns() const;
  bool has(const std::string& column) const;
  bool has_words(const std::string& column) const;

  /// One number a row, NaN where the cell is empty. Valid as long as any copy of this table. Throws SceneError for a
  /// name that is none, or a column of words.
  std::span<const double> numbers(const std::string& column) const;
  /// One word a row; numbers as in csv().
  std::vector<std::string> words(const std::string& column) const;

  /// As the program writes it: 17 significant digits, empty cells.
  std::string csv() const;

  struct Inside;
  explicit Table(std::shared_ptr<const Inside> inside) : inside_(std::move(inside)) {}

 private:
  std::size_t index(const std::string& column) const;
  std::shared_ptr<const Inside> inside_;
};

}  // namespace genu::api
