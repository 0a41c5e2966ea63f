#include "hard_cases/hard_case_check.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "hard_cases/formula.h"

namespace genu {
namespace {

std::string word_at(const ResultTable& table, std::size_t row, const std::string& column) {
  const Cell& cell = table.at(row, table.column_index(column));
  return std::holds_alternative<std::string>(cell) ? std::get<std::string>(cell) : std::string();
}

const ResultTable* table_of(const ExpectedValue& value, const Solution& solution) {
  switch (value.table) {
    case ExpectedValue::Table::events:
      return &solution.event_rows;
    case ExpectedValue::Table::starts:
      return solution.starts ? &*solution.starts : nullptr;
    case ExpectedValue::Table::results:
      break;
  }
  return &solution.poses;
}

/// The rows that a value is expected in; empty where the table has none of them.
std::vector<std::size_t> rows_of(const ExpectedValue& value, const ResultTable& table) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (!value.event.empty() && word_at(table, row, "event") != value.event) continue;
    const bool blank = std::holds_alternative<std::monostate>(table.at(row, table.column_index(value.column)));
    if (!value.row && blank) continue;
    rows.push_back(row);
  }
  if (!value.row) return rows;
  const auto index = static_cast<std::size_t>(std::abs(*value.row));
  if (index > rows.size()) return {};
  return {*value.row > 0 ? rows[index - 1] : rows[rows.size() - index]};
}

std::string check_number(const ExpectedValue& value, const ResultTable& table, std::size_t row) {
  const auto value_of = [&](const std::string& name) -> std::optional<double> {
    if (!table.has_column(name)) return std::nullopt;
    const double x = table.number(row, name);
    return std::isnan(x) ? std::nullopt : std::optional(x);
  };
  std::string why;
  const auto expected = evaluate_formula(value.value, value_of, why);
  if (!expected) return fmt::format("{}: the formula {}: {}", value.column, value.value, why);
  const double found = table.number(row, value.column);
  if (std::abs(found - *expected) <= value.tolerance) return {};
  return fmt::format("{} in row {} is {:.12g}, not {:.12g} within {:g}", value.column, row + 1, found, *expected,
                     value.tolerance);
}

/// The first row in which a value is wrong; empty where it is right.
std::string check_value(const ExpectedValue& value, const Solution& solution) {
  const ResultTable* table = table_of(value, solution);
  if (table == nullptr || !table->has_column(value.column)) return "there is no column " + value.column;
  const std::vector<std::size_t> rows = rows_of(value, *table);
  if (rows.empty()) return "there is no row for " + value.column + (value.event.empty() ? "" : " of " + value.event);
  for (const std::size_t row : rows) {
    std::string wrong;
    if (value.is_word) {
      const std::string found = word_at(*table, row, value.column);
      if (found != value.value) wrong = fmt::format("{} is \"{}\", not \"{}\"", value.column, found, value.value);
    } else {
      wrong = check_number(value, *table, row);
    }
    if (!wrong.empty()) return wrong;
  }
  return {};
}

int count_words(const ResultTable& table, const std::string& column, const std::string& word) {
  int count = 0;
  for (std::size_t row = 0; table.has_column(column) && row < table.rows(); ++row)
    count += static_cast<int>(word_at(table, row, column) == word);
  return count;
}

void check_statuses(const Expectation& expected, const Solution& solution, std::vector<std::string>& out) {
  if (expected.statuses.empty()) return;
  std::size_t counted = 0;
  for (const auto& [status, count] : expected.statuses) {
    const int found = count_words(solution.poses, "status", status);
    counted += static_cast<std::size_t>(found);
    if (found != count) out.push_back(fmt::format("{} rows are {}, not {}", found, status, count));
  }
  if (counted < solution.poses.rows())
    out.push_back(fmt::format("{} rows have a status that is not expected", solution.poses.rows() - counted));
}

}  // namespace

std::string words_of(const CaseResult& result) {
  std::string out;
  for (const Diagnostic& d : result.diagnostics.items()) out += to_string(d) + "\n";
  for (const std::string& sentence : result.solution.summary.verdict) out += sentence + "\n";
  for (const PoseRecord& record : result.solution.records) out += record.point.report.why + "\n";
  for (const PathEvent& event : result.solution.events)
    out += std::string(to_string(event.kind)) + " " + event.what + "\n";
  return out;
}

int work_of(const RunSummary& summary) {
  return summary.motion ? static_cast<int>(summary.motion->steps) : summary.iterations;
}

std::vector<std::string> misses(const Expectation& expected, const CaseResult& result) {
  std::vector<std::string> out;
  const std::string words = words_of(result);
  if (result.exit_code != expected.exit_code)
    out.push_back(fmt::format("exit code {}, not {}: {}", result.exit_code, expected.exit_code,
                              words.substr(0, words.find('\n'))));
  check_statuses(expected, result.solution, out);
  for (const auto& [event, count] : expected.events)
    if (const int found = count_words(result.solution.event_rows, "event", event); found != count)
      out.push_back(fmt::format("{} events {}, not {}", found, event, count));
  if (const int work = work_of(result.solution.summary); expected.most_iterations && work > *expected.most_iterations)
    out.push_back(fmt::format("{} iterations or steps, at most {}", work, *expected.most_iterations));
  for (const std::string& text : expected.says)
    if (words.find(text) == std::string::npos) out.push_back("nothing says \"" + text + "\"");
  for (const std::string& text : expected.says_not)
    if (words.find(text) != std::string::npos) out.push_back("something says \"" + text + "\"");
  for (const ExpectedValue& value : expected.values)
    if (std::string wrong = check_value(value, result.solution); !wrong.empty()) out.push_back(std::move(wrong));
  return out;
}

}  // namespace genu
