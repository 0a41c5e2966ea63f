#include "genu/calibrate/calibration_target.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "genu/assemble/long_errors.h"
#include "genu/assemble/pose_file.h"
#include "genu/calibrate/finite_number.h"
#include "genu/calibrate/tolerances.h"
#include "genu/scene/words.h"

namespace genu {
namespace {

constexpr const char* kTime = "time_s";

/// Counts and words of a results.csv: nothing to follow.
bool is_no_value(const std::string& name) {
  return name == "step" || name == "increment" || name == "status" || name == "stability";
}

class TargetReader {
 public:
  TargetReader(const PoseFile& file, double duration, const std::vector<TargetAxis>& axes, Diagnostics& out)
      : file_(file), axis_{kTime, 0, duration}, errors_(file.path, out) {
    for (const TargetAxis& axis : axes)
      if (!has(kTime) && axis_.column == kTime && has(axis.column)) axis_ = axis;
  }

  void choose(const std::vector<std::string>& patterns, const std::vector<std::string>& known) {
    for (std::size_t c = 0; c < file_.names.cells.size(); ++c) {
      const PoseFile::Cell& cell = file_.names.cells[c];
      const auto asked = [&](const std::string& pattern) { return matches(pattern, cell.text); };
      if (cell.text == axis_.column)
        time_ = c;
      else if (is_no_value(cell.text) || (!patterns.empty() && std::none_of(patterns.begin(), patterns.end(), asked)))
        continue;
      else if (std::find(known.begin(), known.end(), cell.text) == known.end())
        errors_.add({file_.names.line, cell.column}, Code::unknown_name, cell.text, {},
                    "is no column of this scene's results.csv" + did_you_mean(cell.text, known));
      else
        add_column(c, cell.text);
    }
    for (const std::string& pattern : patterns)
      if (std::none_of(file_.names.cells.begin(), file_.names.cells.end(),
                       [&](const PoseFile::Cell& cell) { return matches(pattern, cell.text); }))
        errors_.add({file_.names.line, 1}, Code::unknown_name, "--columns", with_quotes(pattern),
                    "is no column of the target" + did_you_mean(pattern, names()));
    if (!time_)
      errors_.add({file_.names.line, 1}, Code::missing_key, kTime, {},
                  "is missing: a target says when each of its rows is, by the time or by a prescribed coordinate that "
                  "does not turn back");
    if (errors_.count() == 0 && target_.columns.empty())
      errors_.add({file_.names.line, 1}, Code::missing_key, {}, {}, "has no column to follow beside " + axis_.column);
  }

  /// Columns of the file that are followed, and that of times.
  std::vector<std::size_t> used() const {
    std::vector<std::size_t> columns = cells_;
    if (time_) columns.push_back(*time_);
    return columns;
  }

  std::optional<CalibrationTarget> read() {
    target_.axis = axis_.column;
    if (errors_.count() > 0) return std::nullopt;
    for (const PoseFile::Row& row : file_.rows) add_row(row);
    if (errors_.count() == 0 && target_.values.empty())
      errors_.add({file_.names.line, 1}, Code::missing_key, {}, {}, "holds no values below its column names");
    if (errors_.count() > 0) return std::nullopt;
    for (std::size_t c = 0; c < target_.columns.size(); ++c) target_.columns[c].scale = scale_of(c);
    return std::move(target_);
  }

 private:
  bool has(const std::string& name) const {
    return std::any_of(file_.names.cells.begin(), file_.names.cells.end(),
                       [&](const PoseFile::Cell& cell) { return cell.text == name; });
  }

  std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const PoseFile::Cell& cell : file_.names.cells) out.push_back(cell.text);
    return out;
  }

  void add_column(std::size_t cell, const std::string& name) {
    cells_.push_back(cell);
    target_.columns.push_back({name, 1});
  }

  std::optional<double> number(const PoseFile::Row& row, std::size_t c) {
    const PoseFile::Cell& cell = row.cells[c];
    const auto value = finite_number(cell.text);
    if (!value && has_decimal_comma(cell.text) && std::exchange(comma_refused_, true)) return value;  // said once
    if (!value)
      errors_.add(
          {row.line, cell.column}, Code::out_of_range, file_.names.cells[c].text, with_quotes(cell.text),
          has_decimal_comma(cell.text) ? file_.no_number(cell.text) : "must be a finite number, of at most 1e20");
    return value;
  }

  void add_row(const PoseFile::Row& row) {
    const auto time = number(row, *time_);
    const double slack = kSameTime * std::max(std::abs(axis_.low), std::abs(axis_.high));
    if (time && (*time < axis_.low - slack || *time > axis_.high + slack))
      errors_.add({row.line, row.cells[*time_].column}, Code::out_of_range, axis_.column, row.cells[*time_].text,
                  fmt::format("is outside of what the scene computes: {:g} to {:g}{}", axis_.low, axis_.high,
                              axis_.column == kTime ? " s" : ""));
    for (std::size_t k = 0; k < cells_.size(); ++k) {
      if (row.cells[cells_[k]].text.empty()) continue;
      const auto value = number(row, cells_[k]);
      if (time && value) target_.values.push_back({*time, k, *value});
    }
  }

  double scale_of(std::size_t column) const {
    double sum = 0, largest = 0, square = 0, count = 0;
    for (const auto& v : target_.values)
      if (v.column == column) sum += v.value, largest = std::max(largest, std::abs(v.value)), ++count;
    for (const auto& v : target_.values)
      if (v.column == column) square += std::pow(v.value - sum / count, 2);
    const double spread = count > 0 ? std::sqrt(square / count) : 0;
    return spread > kConstantSpread * largest ? spread : largest > 0 ? largest : 1;
  }

  const PoseFile& file_;
  TargetAxis axis_;
  LongErrors errors_;
  std::optional<std::size_t> time_;
  std::vector<std::size_t> cells_;  ///< of each column of the target
  CalibrationTarget target_;
  bool comma_refused_ = false;
};

/// Lagrange's weights of rows `first` .. `last` - 1 at t.
std::vector<double> weights(const std::vector<double>& times, std::size_t first, std::size_t last, double t) {
  std::vector<double> w;
  for (std::size_t i = first; i < last; ++i) {
    double product = 1;
    for (std::size_t j = first; j < last; ++j)
      if (j != i) product *= (t - times[j]) / (times[i] - times[j]);
    w.push_back(product);
  }
  return w;
}

}  // namespace

std::optional<CalibrationTarget> read_calibration_target(const std::string& path,
                                                         const std::vector<std::string>& patterns,
                                                         const std::vector<std::string>& known, double duration,
                                                         Diagnostics& out, const std::vector<TargetAxis>& axes) {
  const auto file = read_pose_file(path, out);
  if (!file) return std::nullopt;
  TargetReader reader(*file, duration, axes, out);
  reader.choose(patterns, known);
  const std::size_t before = out.count(Diagnostic::Severity::error);
  refuse_repeated_names(*file, reader.used(), out);
  if (out.count(Diagnostic::Severity::error) > before) return std::nullopt;
  return reader.read();
}

std::vector<std::vector<RowWeight>> rows_of(const CalibrationTarget& target, const ResultTable& results) {
  constexpr std::size_t kCubic = 4;
  std::vector<double> times;
  for (std::size_t row = 0; row < results.rows(); ++row) times.push_back(results.number(row, target.axis));
  const bool falls = times.size() > 1 && times.front() > times.back();
  if (falls) std::reverse(times.begin(), times.end());
  std::vector<std::vector<RowWeight>> out;
  if (times.empty()) return out;
  const auto row_of = [&](std::size_t k) { return falls ? times.size() - 1 - k : k; };
  for (const CalibrationTarget::Value& v : target.values) {
    const auto after = static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), v.time) - times.begin());
    const std::size_t near =
        after == times.size() || (after > 0 && v.time - times[after - 1] < times[after] - v.time) ? after - 1 : after;
    const double step = times.size() > 1 ? (times.back() - times.front()) / static_cast<double>(times.size() - 1) : 1;
    out.emplace_back();
    if (std::abs(times[near] - v.time) <= kSameTime * step) {
      out.back().push_back({row_of(near), 1});
      continue;
    }
    const std::size_t count = std::min(kCubic, times.size());
    const std::size_t first = std::min(after < 2 ? 0 : after - 2, times.size() - count);
    const std::vector<double> w = weights(times, first, first + count, v.time);
    for (std::size_t i = 0; i < count; ++i) out.back().push_back({row_of(first + i), w[i]});
  }
  return out;
}

std::optional<VecX> values_at(const CalibrationTarget& target, const ResultTable& results) {
  const std::vector<std::vector<RowWeight>> rows = rows_of(target, results);
  if (rows.empty()) return std::nullopt;
  VecX values = VecX::Zero(static_cast<Eigen::Index>(target.values.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::string& column = target.columns[target.values[k].column].name;
    double& value = values[static_cast<Eigen::Index>(k)];
    for (const RowWeight& r : rows[k]) value += r.weight * results.number(r.row, column);
    if (!std::isfinite(value)) return std::nullopt;
  }
  return values;
}

}  // namespace genu
