// What `genu sensitivity` leaves behind: a table of derivatives, a ranking and a picture.
#pragma once

#include "genu/results/chart.h"
#include "genu/results/outputs.h"

namespace genu {

/// Derivatives of outputs to parameters at every row of a run.
struct SensitivityRows {
  std::vector<Output> outputs;
  std::vector<Parameter> parameters;
  /// Of each parameter: those that it moves together, each by its standard change, where it is a bundle; empty where it
  /// is one of the scene's. Its derivative is per one such move, its effect the sum of theirs.
  std::vector<std::vector<Parameter>> bundles = {};
  /// In the units of output and parameter: row by row, output by output, parameter by parameter; NaN where there is
  /// none.
  std::vector<double> derivatives;

  double derivative(std::size_t row, std::size_t output, std::size_t parameter) const {
    return derivatives[(row * outputs.size() + output) * parameters.size() + parameter];
  }
  /// What the parameter's standard change does to the output, to first order, in the output's unit.
  double effect(std::size_t row, std::size_t output, std::size_t parameter) const {
    return derivative(row, output, parameter) * parameters[parameter].change / parameters[parameter].si;
  }
  std::size_t rows() const {
    const std::size_t one = outputs.size() * parameters.size();
    return one == 0 ? 0 : derivatives.size() / one;
  }
};

/// A parameter's importance for an output: the largest effect along the path.
struct RankedParameter {
  std::size_t parameter = 0;
  std::size_t row = 0;   ///< where the effect is largest
  double largest = 0;    ///< its value there, signed
  double mean_size = 0;  ///< root of the mean square over all rows that have one
  /// Others that do the same everywhere, such as both radii of a torus and its plane's height.
  std::vector<std::size_t> alike = {};
};

/// Of one output, the most important first; without those that have no effect at all.
std::vector<RankedParameter> ranking(const SensitivityRows& rows, std::size_t output);

/// sensitivity.csv: one row for each pose, output and parameter. `poses` is the run's pose_table().
std::string sensitivity_csv(const SensitivityRows& rows, const SceneTables& scene, const std::vector<StepPlan>& steps,
                            const ResultTable& poses);

/// ranking.csv: one row for each output and parameter, with the place on the path where the effect is largest.
ResultTable ranking_table(const SensitivityRows& rows, const SceneTables& scene, const std::vector<StepPlan>& steps,
                          const ResultTable& poses);

/// The ranking for a terminal, `most` parameters of each output.
std::string ranking_text(const SensitivityRows& rows, const SceneTables& scene, const std::vector<StepPlan>& steps,
                         const ResultTable& poses, std::size_t most);

/// The effects of the most important parameters along the path, a panel for each of the first outputs. `axis` gives
/// title and x axis: the chart of the run.
Chart sensitivity_chart(const SensitivityRows& rows, const Chart& axis);

}  // namespace genu
