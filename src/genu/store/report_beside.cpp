#include "genu/store/report_beside.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "genu/assemble/column_units.h"
#include "genu/assemble/plain_text.h"
#include "genu/assemble/pose_file.h"
#include "genu/assemble/refuse_option.h"
#include "genu/results/columns.h"
#include "genu/scene/tolerances.h"
#include "genu/scene/words.h"
#include "genu/store/beside_units.h"

namespace genu {
namespace {

/// A number, NaN for "nan" and an empty cell; nothing for another word.
std::optional<double> number_of(const std::string& text) {
  if (text.empty() || lower_case(text) == "nan") return std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [end, code] = std::from_chars(first, text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size() || !(std::abs(value) <= kMaxNumber)) return std::nullopt;
  return value;
}

class BesideReader {
 public:
  BesideReader(const PoseFile& file, const std::vector<std::string>& known, Diagnostics& out)
      : file_(file), known_(known), out_(out) {
    for (const TextCell& cell : file.names.cells) names_.push_back(cell.text);
    storage_ = file.path.ends_with(".sto") || file.path.ends_with(".mot");
  }

  std::optional<ReportBeside> read(const std::string& columns) {
    const std::size_t before = out_.count(Diagnostic::Severity::error);
    choose(columns);
    for (std::size_t c = 0; c < names_.size(); ++c) choose_by_name(c);
    if (out_.count(Diagnostic::Severity::error) == before && chosen_.size() < 2)
      out_.add(
          error_at({file_.path, {file_.names.line, 1}}, Code::missing_key, {}, {},
                   fmt::format("has {} with results.csv, and a curve needs two: name others with --columns "
                               "\"knee.flexion=angle[deg], ...\" (here: {})",
                               chosen_.empty() ? "no column in common" : "one column in common", quoted_list(names_))));
    std::vector<std::size_t> used;
    for (const auto& [column, chosen] : chosen_) used.push_back(chosen.cell);
    refuse_repeated_names(file_, used, out_);
    if (out_.count(Diagnostic::Severity::error) > before) return std::nullopt;
    ReportBeside found;
    found.name = std::filesystem::path(file_.path).filename().string();
    {
      LongErrors errors(file_.path, out_);
      for (const std::string& column : known_)
        if (const auto chosen = chosen_.find(column); chosen != chosen_.end())
          found.columns.push_back({column, names_[chosen->second.cell], numbers(chosen->second, errors)});
    }
    if (out_.count(Diagnostic::Severity::error) > before) return std::nullopt;
    if (missing_ > 0)
      out_.warning(Code::no_effect, file_.path,
                   fmt::format("{} cells hold no number and are left out of the report", missing_));
    return found;
  }

 private:
  struct Chosen {
    std::size_t cell = 0;
    double factor = 1;  ///< from the file's unit to that of results.csv
  };

  /// The column of results.csv that a name means; empty where there is none.
  std::string meant(const std::string& name) const {
    for (const std::string& column : known_)
      if (column == name || without_unit(column) == name) return column;
    return {};
  }

  /// The columns of results.csv, with and without their units.
  std::vector<std::string> quantities() const {
    std::vector<std::string> out;
    for (const std::string& column : known_) out.insert(out.end(), {without_unit(column), column});
    return out;
  }

  void choose(const std::string& text) {
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find(',', begin), text.size());
      const std::string part(trimmed(text.substr(begin, end - begin)));
      begin = end + 1;
      const std::size_t equals = part.find('=');
      if (equals == std::string::npos || equals + 1 == part.size()) {
        refuse_option(out_, Code::wrong_form, "--columns", part,
                      "must be COLUMN=NAME, such as knee.flexion=angle[deg]");
        continue;
      }
      choose_one(std::string(trimmed(part.substr(0, equals))), std::string(trimmed(part.substr(equals + 1))));
    }
  }

  void choose_one(const std::string& quantity, const std::string& name) {
    const std::string column = meant(quantity);
    if (column.empty())
      return refuse_option(out_, Code::unknown_name, "--columns", quantity,
                           "is no column of this scene's results.csv" + did_you_mean(quantity, quantities()));
    std::string bare = name, unit;
    auto at = std::find(names_.begin(), names_.end(), bare);
    if (at == names_.end() && name.ends_with(']') && name.rfind('[') != std::string::npos) {
      bare = std::string(trimmed(name.substr(0, name.rfind('['))));
      unit = bare_unit(name.substr(name.rfind('[')));
      at = std::find(names_.begin(), names_.end(), bare);
    }
    if (at == names_.end())
      return refuse_option(
          out_, Code::unknown_name, "--columns", name,
          "is no column of " + file_.path + did_you_mean(bare, names_) + " (there: " + quoted_list(names_) + ")");
    const auto cell = static_cast<std::size_t>(at - names_.begin());
    if (!chosen_.emplace(column, Chosen{cell, factor(column, cell, unit)}).second)
      refuse_option(out_, Code::duplicate, "--columns", quantity, "is given twice");
  }

  void choose_by_name(std::size_t cell) {
    const std::string& name = names_[cell];
    for (const char* word : {"step", "increment", "status", "stability", "branch"})
      if (name == word) return;
    for (const auto& [column, chosen] : chosen_)
      if (chosen.cell == cell) return;
    std::string column = meant(name == "time" ? "time_s" : name), unit;
    if (column.empty() && (name.ends_with(']') || name.ends_with(')'))) {
      const std::size_t open = name.rfind(name.back() == ']' ? '[' : '(');
      if (open == std::string::npos) return;
      column = meant(std::string(trimmed(name.substr(0, open))));
      unit = bare_unit(name.substr(open));
    }
    if (!column.empty() && chosen_.count(column) == 0)
      chosen_.emplace(column, Chosen{cell, factor(column, cell, unit)});
  }

  /// From `unit`, else that of the file's own name, else the one that values without a unit have.
  double factor(const std::string& column, std::size_t cell, std::string unit) {
    const FilePlace place{file_.path, {file_.names.line, file_.names.cells[cell].column}};
    if (unit.empty() && names_[cell] != column) unit = unit_in_name(names_[cell], column);
    if (unit.empty()) {
      if (names_[cell] == column) return 1;
      unit = unit_unsaid(column, file_.angles);
      const double factor = unit_factor(column, unit).value_or(1);
      if (factor != 1 && !storage_)
        out_.add(warning_at(place, Code::missing_key, names_[cell], {},
                            fmt::format("is read in {}, because it has no unit: say --columns \"{}={}[{}]\", or the "
                                        "unit that it is in",
                                        unit, without_unit(column), names_[cell], unit)));
      return factor;
    }
    if (const auto known = unit_factor(column, unit)) return *known;
    out_.add(error_at(place, Code::wrong_form, names_[cell], with_quotes(unit),
                      fmt::format("is no unit of {}: {}", column, units_of(column))));
    return 1;
  }

  std::vector<double> numbers(const Chosen& chosen, LongErrors& errors) {
    std::vector<double> out;
    for (const PoseFile::Row& row : file_.rows) {
      const TextCell& cell = row.cells[chosen.cell];
      const auto value = number_of(cell.text);
      if (!value)
        errors.add({row.line, cell.column}, Code::wrong_form, names_[chosen.cell], with_quotes(cell.text),
                   has_decimal_comma(cell.text) ? file_.no_number(cell.text)
                                                : "must be a number of at most 1e20, or empty where none was measured");
      out.push_back(chosen.factor * value.value_or(0));
      missing_ += std::isfinite(out.back()) ? 0 : 1;
    }
    return out;
  }

  const PoseFile& file_;
  const std::vector<std::string>& known_;
  Diagnostics& out_;
  std::vector<std::string> names_;
  bool storage_ = false;
  std::map<std::string, Chosen> chosen_;  ///< by column of results.csv
  std::size_t missing_ = 0;
};

}  // namespace

std::optional<ReportBeside> read_beside(const std::string& path, const std::string& columns,
                                        const std::vector<std::string>& known, Diagnostics& out) {
  const auto file = read_pose_file(path, out);
  if (!file) return std::nullopt;
  return BesideReader(*file, known, out).read(columns);
}

}  // namespace genu
