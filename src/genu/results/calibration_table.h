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
    std::string note = {};        ///< "slack in every pose", "at its bound", ...
    double prior = 0;             ///< SD of its prior, in `unit`; 0: it has none
  };
  struct Column {
    std::string name;  ///< of results.csv, with its unit
    std::size_t values = 0;
    double rms = 0;    ///< of target - scene, in the column's unit
    double scale = 1;  ///< its residuals were divided by this
    std::string file = {};
    bool stated = false;    ///< `scale` is the measurement's stated error
    bool held_out = false;  ///< not fitted
  };
  /// One start of the fit.
  struct Start {
    std::string name, stop;
    std::vector<double> start, end;  ///< of each parameter, in its unit
    double rms = 0;
    int iterations = 0;
  };
  std::vector<Parameter> parameters;
  MatX correlation;  ///< of the parameters
  std::vector<std::string>
      undetermined;  ///< what the target says nothing of: "j1.damping", "a.stiffness + 0.7 b.stiffness"
  std::vector<Column> columns;
  std::string stop;  ///< why it ended, in words
  bool converged = false;
  std::string misfit;              ///< a sentence: residuals are far beyond the stated errors; empty: they are not
  int iterations = 0, runs = 0;    ///< of the scene, those for derivatives too
  bool exact = false;              ///< derivatives are exact, not differences
  std::vector<std::string> slack;  ///< sentences: what is slack in every pose, and from where on it would pull
  std::string poorest;             ///< the direction that is determined least: "MCLa +0.71, MCLp -0.70"; empty: none
  double poorest_deviation = 0;    ///< its standard error, in shares of the start or of the unknown's scale
  std::vector<Start> starts;
  double start_rms = 0, rms = 0;  ///< of all residuals over their columns' scales
};

/// One row a parameter: name, unit, start, value, standard error, and its correlation with each.
ResultTable calibration_table(const CalibrationReport& report);

/// One row a start: name, how it ended, rms, and each parameter at its begin and end.
ResultTable starts_table(const CalibrationReport& report);

/// Aligned lines for a terminal.
std::string to_text(const CalibrationReport& report);

}  // namespace genu
