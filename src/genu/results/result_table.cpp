#include "genu/results/result_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "genu/core/file_text.h"
namespace genu {
namespace {

struct ToCsv {
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(double value) const { return fmt::format("{:.17g}", value); }
  std::string operator()(long value) const { return fmt::format("{}", value); }
  std::string operator()(const std::string& value) const { return csv_word(value); }
};

struct ToText {
  int digits;
  std::string operator()(std::monostate) const { return "-"; }
  std::string operator()(double value) const {
    std::string text = fmt::format("{:.{}f}", value, digits);
    const bool zero = text.find_first_of("123456789") == std::string::npos;
    return zero && text[0] == '-' ? text.substr(1) : text;
  }
  std::string operator()(long value) const { return fmt::format("{}", value); }
  std::string operator()(const std::string& value) const { return value; }
};

}  // namespace

std::size_t ResultTable::add_column(const std::string& name) {
  const auto [it, added] = index_.emplace(name, columns_.size());
  if (added) {
    columns_.push_back(name);
    for (auto& row : rows_) row.emplace_back();
  }
  return it->second;
}

void ResultTable::set(std::size_t column, Cell value) {
  if (const double* number = std::get_if<double>(&value); number != nullptr && !std::isfinite(*number)) value = {};
  rows_.back().at(column) = std::move(value);
}

double ResultTable::number(std::size_t row, std::string_view column) const {
  const Cell& cell = rows_[row][column_index(column)];
  if (const double* value = std::get_if<double>(&cell)) return *value;
  if (const long* value = std::get_if<long>(&cell)) return static_cast<double>(*value);
  return std::numeric_limits<double>::quiet_NaN();
}

std::string ResultTable::to_csv() const {
  std::string out;
  for (std::size_t c = 0; c < columns_.size(); ++c) out += (c > 0 ? "," : "") + csv_word(columns_[c]);
  out += '\n';
  for (const auto& row : rows_) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (c > 0) out += ',';
      out += std::visit(ToCsv{}, row[c]);
    }
    out += '\n';
  }
  return out;
}

std::string to_text(const ResultTable& table, const std::vector<std::string>& columns, int digits,
                    std::size_t most_rows) {
  std::vector<std::size_t> rows;
  const std::size_t shown = std::min(most_rows, table.rows());
  for (std::size_t k = 0; k < shown; ++k) rows.push_back(shown < 2 ? 0 : k * (table.rows() - 1) / (shown - 1));
  std::string out;
  std::vector<std::string> lines(rows.size() + 1);
  for (const std::string& name : columns) {
    const std::size_t column = table.column_index(name);
    std::vector<std::string> cells{name};
    for (const std::size_t row : rows) cells.push_back(std::visit(ToText{digits}, table.at(row, column)));
    std::size_t width = 0;
    for (const std::string& cell : cells) width = std::max(width, cell.size());
    for (std::size_t i = 0; i < cells.size(); ++i) lines[i] += fmt::format("  {:>{}}", cells[i], width);
  }
  for (const std::string& line : lines) out += line + '\n';
  return out;
}

}  // namespace genu
