// The curves that a calibration follows: a CSV file with times and columns of results.csv.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/core/types.h"
#include "genu/results/result_table.h"

namespace genu {

struct CalibrationTarget {
  struct Column {
    std::string name;  ///< of results.csv
    /// What its residuals are divided by, in its unit: how much its values spread (rms about their mean); of a column
    /// that does not change the size of its values, or 1.
    double scale = 1;
  };
  struct Value {
    double time = 0;         ///< s, or in the unit of `axis`
    std::size_t column = 0;  ///< index into `columns`
    double value = 0;        ///< in the column's unit
  };
  std::string axis = "time_s";  ///< the column that says when a row is: time_s, or a prescribed coordinate
  std::vector<Column> columns;
  std::vector<Value> values;  ///< row by row
};

/// A column of results that only grows, or only falls, along a scene's path: rows of a target may be found by it.
struct TargetAxis {
  std::string column;
  double low = 0, high = 0;  ///< its values on the path, in its unit
};

/// Reads the columns that match one of `patterns` (all where there is none) of a file with a column time_s, or else
/// one of `axes`. Columns step, increment and status are passed over, and empty cells are values that were not
/// measured. What is wrong is added to `out` with its place: a name that is none of `known`, a cell that is no finite
/// number, a time outside of 0 to `duration`, no values.
[[nodiscard]] std::optional<CalibrationTarget> read_calibration_target(const std::string& path,
                                                                       const std::vector<std::string>& patterns,
                                                                       const std::vector<std::string>& known,
                                                                       double duration, Diagnostics& out,
                                                                       const std::vector<TargetAxis>& axes = {});

/// A row of results and its weight.
struct RowWeight {
  std::size_t row = 0;
  double weight = 1;
};

/// For each value of the target the rows of results that make it: one where a row has its time, else the cubic through
/// four rows about it. Empty without rows.
std::vector<std::vector<RowWeight>> rows_of(const CalibrationTarget& target, const ResultTable& results);

/// The values of results at the target's times. Empty where a cell is.
std::optional<VecX> values_at(const CalibrationTarget& target, const ResultTable& results);

}  // namespace genu
