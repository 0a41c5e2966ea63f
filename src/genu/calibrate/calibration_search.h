// The fit of a calibration: residuals of all experiments and priors over their errors, minimised from one start or
// several, and again from just taut where a ligament is slack in every pose.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "genu/calibrate/calibration_experiment.h"
#include "genu/core/cancelled.h"
#include "genu/core/least_squares.h"

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
  };
  At at(const VecX& u, bool derivatives) const;
  /// Exact where all experiments have exact ones, else central differences, side by side on all threads.
  std::optional<MatX> jacobian(const At& at) const;
  /// The residuals are target's values first, then priors.
  Eigen::Index target_rows() const;

  const std::vector<CalibrationUnknown>& unknowns() const { return unknowns_; }
  const std::vector<std::unique_ptr<CalibrationExperiment>>& experiments() const { return experiments_; }
  int runs() const { return runs_; }  ///< of experiments

 private:
  const std::vector<CalibrationUnknown>& unknowns_;
  const std::vector<std::unique_ptr<CalibrationExperiment>>& experiments_;
  double difference_;
  mutable std::atomic<int> runs_ = 0;
};

struct CalibrationSearchOptions {
  int most_iterations = 50;
  int starts = 1;     ///< the scene's own numbers, then others around them, the same ones always
  double spread = 3;  ///< how far these go, in standard changes
  Cancelled cancelled;
};

/// What one start led to.
struct CalibrationStart {
  std::string name;  ///< "1", "2", "2, MCLa taut"
  VecX start, end;   ///< u
  LeastSquaresStop stop = LeastSquaresStop::no_start;
  int iterations = 0;
  double rms = 0;  ///< of the residuals at the end
};

struct CalibrationSearch {
  LeastSquaresResult fit;  ///< the best
  CalibrationProblem::At at_start, at_end;
  MatX jacobian;  ///< there; empty where there is none
  bool exact = false;
  std::vector<CalibrationStart> starts;
  std::vector<std::size_t> slack;  ///< unknowns that are slack in every pose at the end
};

/// `start`: at u = 0, with derivatives.
CalibrationSearch search(const CalibrationProblem& problem, const CalibrationSearchOptions& options,
                         const CalibrationProblem::At& start);

/// [1] How far the derivatives can be trusted, over the largest.
double derivative_noise(bool exact);

/// u at which the member of a slack unknown that is nearest to taut has the strain kTautStrain where it is longest.
/// Empty where that needs another law, or goes beyond the unknown's bounds.
std::optional<double> taut_start(const CalibrationUnknown& unknown, double u,
                                 const std::vector<CalibrationPrediction::Stretch>& stretch, double strain);

}  // namespace genu
