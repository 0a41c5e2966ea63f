#include "genu/judge/results_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "genu/judge/tolerances.h"

namespace genu::judge {
namespace {

constexpr double kEmptyCell = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string_view> split(std::string_view text, char by) {
  std::vector<std::string_view> parts;
  for (std::size_t from = 0;;) {
    const std::size_t to = text.find(by, from);
    parts.push_back(text.substr(from, to == std::string_view::npos ? to : to - from));
    if (to == std::string_view::npos) return parts;
    from = to + 1;
  }
}

/// The number in a cell; in columns of words, none.
std::optional<double> number_in(std::string_view cell) {
  if (cell.empty()) return kEmptyCell;
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  // A number too small for a double is 0 to any tolerance here; one too large is no result.
  if (error == std::errc() && end == cell.data() + cell.size() && std::isfinite(value)) return value;
  return std::nullopt;
}

/// Whether `word` is a value of column `status`.
bool is_status(std::string_view word) {
  constexpr std::string_view kWords[] = {"ok",        "no_equilibrium",  "over_edge",    "overlap",
                                         "chatter",   "overconstrained", "undetermined", "flawed_mesh",
                                         "slips_off", "lifts_off"};
  return std::find(std::begin(kWords), std::end(kWords), word) != std::end(kWords);
}

/// Removes the byte-order mark and carriage returns that other programs add.
std::string as_written(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  std::string out(text.substr(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0));
  for (std::size_t at = 0; (at = out.find("\r\n", at)) != std::string::npos;) out.erase(at, 1);
  return out;
}

bool holds_words(const std::string& column) { return column == "status" || column == "stability"; }

}  // namespace

std::optional<ResultsFile> ResultsFile::parse(std::string_view bytes, const std::string& file, Diagnostics& out) {
  const std::string text = as_written(bytes);
  ResultsFile table;
  std::size_t errors = 0;
  const auto refuse = [&](std::size_t line, std::size_t column, Code code, std::string found, std::string rule) {
    if (++errors > kMaxFileErrors) return;
    constexpr std::size_t kCharactersShown = 40;
    out.add(error_at({file, {static_cast<int>(line), static_cast<int>(column)}}, code,
                     column > 0 && column <= table.columns_.size() ? table.columns_[column - 1] : "",
                     found.substr(0, kCharactersShown), std::move(rule)));
  };
  std::vector<std::string_view> lines = split(text, '\n');
  if (!lines.back().empty())
    refuse(lines.size(), 0, Code::broken_file, "", "the last line has no end: the file is cut off");
  if (lines.back().empty()) lines.pop_back();
  if (lines.empty())
    return refuse(1, 0, Code::broken_file, "", "is empty: a results.csv begins with a line of names"), std::nullopt;
  for (std::string_view name : split(lines.front(), ',')) {
    table.columns_.emplace_back(name);
    if (!table.index_.emplace(name, table.columns_.size() - 1).second)
      refuse(1, table.columns_.size(), Code::duplicate, std::string(name), "stands twice among the names of columns");
  }
  for (const char* name : {"step", "increment", "status"})
    if (!table.has(name))
      refuse(1, 0, Code::no_results, "", fmt::format("has no column \"{}\": it is no results.csv of genu", name));
  for (std::size_t l = 1; l < lines.size() && errors <= kMaxFileErrors; ++l) {
    const std::vector<std::string_view> cells = split(lines[l], ',');
    if (cells.size() != table.columns_.size()) {
      refuse(l + 1, 0, Code::broken_file, "",
             fmt::format("has {} cells where there are {} columns", cells.size(), table.columns_.size()));
      continue;
    }
    auto& numbers = table.numbers_.emplace_back(cells.size(), kEmptyCell);
    std::string& status = table.status_.emplace_back();
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (table.columns_[c] == "status" && !is_status(status = cells[c]))
        refuse(l + 1, c + 1, Code::unknown_name, status, "is no status that genu gives a row");
      if (holds_words(table.columns_[c])) continue;
      if (const auto number = number_in(cells[c]))
        numbers[c] = *number;
      else
        refuse(l + 1, c + 1, Code::wrong_form, std::string(cells[c]), "is no finite number");
    }
  }
  if (errors > 0) return std::nullopt;
  table.read_ = std::shared_ptr<std::atomic<bool>[]>(new std::atomic<bool>[table.columns_.size()]());
  return table;
}

double ResultsFile::number(std::size_t row, const std::string& column) const {
  const auto found = index_.find(column);
  if (found == index_.end()) return kEmptyCell;
  read_[found->second].store(true, std::memory_order_relaxed);
  return numbers_[row][found->second];
}

std::vector<std::string> ResultsFile::unread() const {
  std::vector<std::string> names;
  for (std::size_t c = 0; c < columns_.size(); ++c)
    if (!read_[c] && columns_[c] != "status") names.push_back(columns_[c]);
  return names;
}

}  // namespace genu::judge
