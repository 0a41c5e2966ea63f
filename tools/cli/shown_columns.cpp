#include "shown_columns.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace genu::cli {
namespace {

bool ends_with(const std::string& s, std::string_view end) { return std::string_view(s).ends_with(end); }

/// Whether a column is zero in all rows, to the decimals of a terminal.
bool shows_zero(const ResultTable& table, const std::string& column) {
  constexpr double kShown = 0.5e-4;
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (std::abs(table.number(row, column)) >= kShown) return false;
  return true;
}

/// A coordinate of a joint, or the force of a pair or region: not of each of its points.
bool is_main_column(const ResultTable& table, const std::string& name) {
  if (name == "time_s") return true;
  if (ends_with(name, "_deg") ||
      (ends_with(name, "_mm") && !ends_with(name, ".gap_mm") && !ends_with(name, ".length_mm")))
    return name.find('.') == name.rfind('.');
  if (!ends_with(name, ".force_N")) return false;
  const std::string object = name.substr(0, name.size() - 8);
  const std::size_t last = object.find_last_not_of("0123456789");
  const bool numbered = last + 1 < object.size() && last != std::string::npos && object[last] == '.';
  return table.has_column(object + ".points") || (!numbered && table.has_column(object + ".gap_mm"));
}

}  // namespace

std::vector<std::string> columns_of_run(const ResultTable& table) {
  constexpr std::size_t kMost = 11;
  const bool motion = table.has_column("energy.balance_J");
  const std::size_t first = motion ? table.column_index("time_s") : table.column_index("status") + 1;
  std::vector<std::size_t> chosen;
  const auto choose = [&](const auto& wanted) {
    for (std::size_t c = first; c < table.columns().size() && chosen.size() < kMost; ++c)
      if (wanted(table.columns()[c])) chosen.push_back(c);
  };
  choose([&](const std::string& name) { return is_main_column(table, name); });
  choose([&](const std::string& name) {
    return name.find(".reaction_") != std::string::npos && !shows_zero(table, name);
  });
  std::sort(chosen.begin(), chosen.end());
  std::vector<std::string> columns;
  for (const std::size_t c : chosen) columns.push_back(table.columns()[c]);
  for (const std::string& name : table.columns())
    if (ends_with(name, ".factor") && columns.size() < kMost + 2) columns.push_back(name);
  for (const std::string& name : table.columns())
    if (motion && ends_with(name, ".force_N") && columns.size() < kMost) columns.push_back(name);
  for (const char* name : {"energy.kinetic_J", "energy.balance_J", "stability", "status"})
    if (table.has_column(name)) columns.push_back(name);
  return columns;
}

}  // namespace genu::cli
