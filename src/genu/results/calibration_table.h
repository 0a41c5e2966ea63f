// What a calibration found, as a table and as text.
#pragma once

#include <string>
#include <vector>

#include "genu/core/types.h"
#include "genu/results/result_table.h"

namespace genu {

struct CalibrationReport {
  struct Parameter {
    std::string name, unit;
    double start = 0, value = 0;  ///< in `unit`
    double deviation = 0;         ///< standard error, in `unit`; infinite where the target does not determine it
  };
  struct Column {
    std::string name;  ///< of results.csv, with its unit
    std::size_t values = 0;
    double rms = 0;    ///< of target - scene, in the column's unit
    double scale = 1;  ///< its residuals were divided by this
  };
  std::vector<Parameter> parameters;
  MatX correlation;  ///< of the parameters
  std::vector<std::string>
      undetermined;  ///< what the target says nothing of: "j1.damping", "a.stiffness + 0.7 b.stiffness"
  std::vector<Column> columns;
  std::string stop;  ///< why it ended, in words
  bool converged = false;
  int iterations = 0, runs = 0;   ///< of the scene, those for derivatives too
  double start_rms = 0, rms = 0;  ///< of all residuals over their columns' scales
};

/// One row a parameter: name, unit, start, value, standard error, and its correlation with each.
ResultTable calibration_table(const CalibrationReport& report);

/// Aligned lines for a terminal.
std::string to_text(const CalibrationReport& report);

}  // namespace genu
