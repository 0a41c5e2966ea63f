#include "genu/api/table_of.h"

#include <algorithm>
#include <limits>
#include <mutex>

#include <fmt/format.h>

#include "genu/api/inside.h"
#include "genu/scene/words.h"

namespace genu::api {

struct Table::Inside {
  explicit Inside(std::shared_ptr<const ResultTable> cells) : held(std::move(cells)), table(*held) {}

  std::shared_ptr<const ResultTable> held;
  const ResultTable& table;
  mutable std::once_flag made;
  mutable std::vector<double> block;  // column after column
  mutable std::vector<bool> worded;

  /// Fills the block at the first call.
  void make() const {
    std::call_once(made, [this] {
      const std::size_t columns = table.columns().size(), rows = table.rows();
      block.assign(columns * rows, std::numeric_limits<double>::quiet_NaN());
      worded.assign(columns, false);
      for (std::size_t c = 0; c < columns; ++c)
        for (std::size_t r = 0; r < rows; ++r) {
          const Cell& cell = table.at(r, c);
          if (const double* number = std::get_if<double>(&cell)) block[c * rows + r] = *number;
          if (const long* number = std::get_if<long>(&cell)) block[c * rows + r] = static_cast<double>(*number);
          if (std::holds_alternative<std::string>(cell)) worded[c] = true;
        }
    });
  }
};

Table table_of(std::shared_ptr<const ResultTable> table) {
  return Table(std::make_shared<const Table::Inside>(std::move(table)));
}
Table table_of(ResultTable table) { return table_of(std::make_shared<const ResultTable>(std::move(table))); }

Table::Table() : Table(std::make_shared<const Inside>(std::make_shared<const ResultTable>())) {}

std::size_t Table::rows() const { return inside_->table.rows(); }
const std::vector<std::string>& Table::columns() const { return inside_->table.columns(); }
bool Table::has(const std::string& column) const { return inside_->table.has_column(column); }
std::string Table::csv() const { return inside_->table.to_csv(); }

std::size_t Table::index(const std::string& column) const {
  if (!has(column))
    refuse(Code::unknown_column, "column", with_quotes(column),
           "is no column of these results" + did_you_mean(column, columns()));
  return inside_->table.column_index(column);
}

bool Table::has_words(const std::string& column) const {
  inside_->make();
  return inside_->worded[index(column)];
}

std::span<const double> Table::numbers(const std::string& column) const {
  if (has_words(column)) refuse(Code::wrong_form, "column", with_quotes(column), "holds words, not numbers");
  return std::span(inside_->block).subspan(index(column) * rows(), rows());
}

std::vector<std::string> Table::words(const std::string& column) const {
  const std::size_t c = index(column);
  std::vector<std::string> words(rows());
  for (std::size_t r = 0; r < words.size(); ++r) {
    const Cell& cell = inside_->table.at(r, c);
    if (const auto* word = std::get_if<std::string>(&cell)) words[r] = *word;
    if (const auto* number = std::get_if<double>(&cell)) words[r] = fmt::format("{:.17g}", *number);
    if (const auto* number = std::get_if<long>(&cell)) words[r] = fmt::format("{}", *number);
  }
  return words;
}

}  // namespace genu::api
