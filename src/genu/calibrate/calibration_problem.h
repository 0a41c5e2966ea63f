// The residuals of a calibration and their derivatives: values of all experiments and priors, over their errors.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "genu/calibrate/calibration_experiment.h"

namespace genu {

/// Least squares over u.
///
///   r(u) = [(y(u) - y*) / sigma; (p(u) - p0) / s]
///
/// y: values of the experiments that are not held out, sigma: their errors; p0, s: priors.
class CalibrationProblem {
 public:
  /// All must outlive this. `difference`: of central differences, where an experiment has no exact derivatives.
  CalibrationProblem(const std::vector<CalibrationUnknown>& unknowns,
                     const std::vector<std::unique_ptr<CalibrationExperiment>>& experiments, double difference);

  /// Everything at u.
  struct At {
    VecX u, residuals;  ///< residuals are empty where an experiment fails
    MatX derivatives;   ///< of the residuals; empty where an experiment has none that are exact
    std::vector<CalibrationPrediction> predictions;  ///< of all experiments; of those held out none
    std::string failed;
    /// Where residuals are empty because some values do not exist: the others, 0 where `there` is false.
    VecX some;
    MatX some_derivatives;
    std::vector<bool> there;

    bool is_partial() const { return residuals.size() == 0 && some.size() > 0; }
  };
  At at(const VecX& u, bool derivatives) const;
  /// Exact where all experiments have exact ones, else central differences, side by side on all threads.
  std::optional<MatX> jacobian(const At& at) const;
  /// The residuals are target's values first, then priors.
  Eigen::Index target_rows() const;

  /// Whether errors of measurement are stated: of all columns, or of none.
  bool has_stated_errors() const;
  /// Sum of squares of m residuals over m - `fitted`, where that is beyond what stated errors make by chance: 1, with a
  /// deviation of sqrt(2 / (m - fitted)), of which kMisfit count as chance. Empty where it is not, or nothing is
  /// stated.
  std::optional<double> misfit(const VecX& residuals, Eigen::Index fitted) const;

  const std::vector<CalibrationUnknown>& unknowns() const { return unknowns_; }
  const std::vector<std::unique_ptr<CalibrationExperiment>>& experiments() const { return experiments_; }
  int runs() const { return runs_; }  ///< of experiments

 private:
  const std::vector<CalibrationUnknown>& unknowns_;
  const std::vector<std::unique_ptr<CalibrationExperiment>>& experiments_;
  double difference_;
  mutable std::atomic<int> runs_ = 0;
};

/// [1] How far the derivatives can be trusted, over the largest.
double derivative_noise(bool exact);

}  // namespace genu
