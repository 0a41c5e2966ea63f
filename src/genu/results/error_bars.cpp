#include "genu/results/error_bars.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "genu/results/tolerances.h"

namespace genu {
namespace {

const double kUnknown = std::numeric_limits<double>::quiet_NaN();

bool is_solved(const ResultTable& poses, std::size_t row) {
  const auto* status = std::get_if<std::string>(&poses.at(row, poses.column_index("status")));
  return status != nullptr && *status == "ok";
}

/// What a bar says something about: measures, by their unit.
bool is_measure(const std::string& column) {
  static const std::vector<std::string> units = {"_mm", "_deg", "_N", "_Nm", "_Nmm", ".strain"};
  return std::any_of(units.begin(), units.end(), [&](const std::string& unit) { return column.ends_with(unit); });
}

/// Rows by step, increment and how often the two have come by.
using RowKey = std::tuple<double, double, int>;
std::map<RowKey, std::size_t> rows_by_key(const ResultTable& poses) {
  std::map<RowKey, std::size_t> out;
  for (std::size_t row = 0; row < poses.rows(); ++row) {
    RowKey key{poses.number(row, "step"), poses.number(row, "increment"), 0};
    while (out.count(key) > 0) ++std::get<2>(key);
    out.emplace(key, row);
  }
  return out;
}

class Spread {
 public:
  Spread(const ResultTable& poses, const std::vector<VariedPoses>& variants) : poses_(poses), variants_(variants) {
    const auto keys = rows_by_key(poses);
    for (const VariedPoses& v : variants) {
      const auto there = rows_by_key(*v.poses);
      std::vector<std::size_t>& rows = row_of_.emplace_back(poses.rows(), kNoRow);
      for (const auto& [key, row] : keys)
        if (const auto it = there.find(key);
            it != there.end() && is_solved(poses, row) && is_solved(*v.poses, it->second))
          rows[row] = it->second;
    }
  }

  int variants_solved(std::size_t row) const {
    return static_cast<int>(
        std::count_if(row_of_.begin(), row_of_.end(), [&](const auto& rows) { return rows[row] != kNoRow; }));
  }

  /// By cause, of one column; NaN where no variant of the cause has it.
  std::vector<std::array<double, kErrorCauses.size()>> shares(const std::string& column) const {
    std::vector<std::array<double, kErrorCauses.size()>> single(poses_.rows()), out;
    std::vector<double> away(variants_.size(), kUnknown);
    for (std::size_t row = 0; row < poses_.rows(); ++row) {
      for (std::size_t v = 0; v < variants_.size(); ++v) away[v] = distance(column, row, v, away[v]);
      for (const ErrorCause cause : kErrorCauses) single[row][index(cause)] = share(away, cause);
    }
    out = single;
    for (std::size_t row = 0; row < poses_.rows(); ++row)
      for (std::size_t c = 0; c < kErrorCauses.size(); ++c)
        for (std::size_t beside = row - std::min(row, kBesideRows);
             beside <= std::min(row + kBesideRows, poses_.rows() - 1); ++beside)
          if (single[beside][c] > out[row][c]) out[row][c] = single[beside][c];
    return out;
  }

  static std::size_t index(ErrorCause cause) { return static_cast<std::size_t>(cause); }

 private:
  static constexpr std::size_t kNoRow = std::numeric_limits<std::size_t>::max();

  /// Of variant `v` from the results; where it has no equilibrium any more, or either has no such cell (an open
  /// contact), the distance `before` that: a bar does not shrink because the surfaces that differ most carry the joint
  /// no further.
  double distance(const std::string& column, std::size_t row, std::size_t v, double before) const {
    if (row_of_[v][row] == kNoRow) return before;
    if (!variants_[v].poses->has_column(column)) return kUnknown;
    const double there = variants_[v].poses->number(row_of_[v][row], column), here = poses_.number(row, column);
    return std::isfinite(there) && std::isfinite(here) ? std::abs(there - here) : before;
  }

  /// Of the variants that are `away` so far, NaN where that is not known.
  double share(const std::vector<double>& away, ErrorCause cause) const {
    double largest = 0, squares = 0;
    int count = 0;
    for (std::size_t v = 0; v < variants_.size(); ++v) {
      if (variants_[v].cause != cause || !std::isfinite(away[v])) continue;
      largest = std::max(largest, away[v]);
      squares += away[v] * away[v];
      ++count;
    }
    if (count == 0) return kUnknown;
    switch (cause) {
      case ErrorCause::fit:
        return largest;
      case ErrorCause::noise:
        return kNoiseDeviations * std::sqrt(squares / count);
      case ErrorCause::mesh:
        return kMeshFactor * largest;
    }
    return kUnknown;
  }

  const ResultTable& poses_;
  const std::vector<VariedPoses>& variants_;
  std::vector<std::vector<std::size_t>> row_of_;  // of each variant: its row for each row of the results
};

/// NaN where no cause is known.
double together(const std::array<double, kErrorCauses.size()>& shares) {
  double sum = 0;
  bool any = false;
  for (const double share : shares) {
    if (!std::isfinite(share)) continue;
    sum += share * share;
    any = true;
  }
  return any ? std::sqrt(sum) : kUnknown;
}

ErrorCause main_cause(const std::array<double, kErrorCauses.size()>& shares) {
  ErrorCause out = ErrorCause::fit;
  for (const ErrorCause cause : kErrorCauses)
    if (!(shares[Spread::index(out)] >= shares[Spread::index(cause)])) out = cause;
  return out;
}

}  // namespace

const char* to_string(ErrorCause cause) {
  switch (cause) {
    case ErrorCause::fit:
      return "fit";
    case ErrorCause::noise:
      return "noise";
    case ErrorCause::mesh:
      return "mesh";
  }
  return "";
}

ErrorBars error_bars(const ResultTable& poses, const std::vector<VariedPoses>& variants) {
  ErrorBars out;
  const Spread spread(poses, variants);
  std::vector<std::string> measures;
  for (const std::string& column : poses.columns())
    if (is_measure(column)) measures.push_back(column);
  for (const char* column : {"step", "increment", "variants"}) out.bars.add_column(column);
  for (const std::string& column : measures) out.bars.add_column(column);
  for (const char* column : {"step", "increment", "output", "bar"}) out.shares.add_column(column);
  for (const ErrorCause cause : kErrorCauses) out.shares.add_column(to_string(cause));

  std::vector<std::vector<std::array<double, kErrorCauses.size()>>> shares;
  for (const std::string& column : measures) shares.push_back(spread.shares(column));
  for (std::size_t row = 0; row < poses.rows(); ++row) {
    out.bars.add_row();
    for (const char* column : {"step", "increment"}) out.bars.set(column, poses.at(row, poses.column_index(column)));
    out.bars.set("variants", static_cast<long>(is_solved(poses, row) ? spread.variants_solved(row) : 0));
    if (!is_solved(poses, row)) continue;
    for (std::size_t m = 0; m < measures.size(); ++m) {
      const double bar = together(shares[m][row]);
      if (!std::isfinite(bar) || !std::isfinite(poses.number(row, measures[m]))) continue;
      out.bars.set(measures[m], bar);
      out.shares.add_row();
      for (const char* column : {"step", "increment"})
        out.shares.set(column, poses.at(row, poses.column_index(column)));
      out.shares.set("output", measures[m]);
      out.shares.set("bar", bar);
      for (const ErrorCause cause : kErrorCauses)
        out.shares.set(to_string(cause), shares[m][row][Spread::index(cause)]);
    }
  }
  for (std::size_t m = 0; m < measures.size(); ++m) {
    ErrorBars::Largest largest{measures[m]};
    std::vector<double> known;
    for (std::size_t row = 0; row < poses.rows(); ++row) {
      const double bar = out.bars.number(row, measures[m]);
      if (!std::isfinite(bar)) continue;
      known.push_back(bar);
      if (known.size() > 1 && bar <= largest.largest) continue;
      largest.largest = bar;
      largest.row = row;
      largest.cause = main_cause(shares[m][row]);
    }
    if (known.empty()) continue;
    std::nth_element(known.begin(), known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2), known.end());
    largest.median = known[known.size() / 2];
    out.largest.push_back(std::move(largest));
  }
  return out;
}

}  // namespace genu
