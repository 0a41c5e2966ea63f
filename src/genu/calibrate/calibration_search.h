// The fit of a calibration: residuals of all experiments and priors over their errors, minimised from one start or
// several, with ligaments made taut that are slack in every pose.
#pragma once

#include <string>
#include <vector>

#include "genu/calibrate/calibration_starts.h"
#include "genu/core/cancelled.h"
#include "genu/core/least_squares.h"

namespace genu {

struct CalibrationSearchOptions {
  int most_iterations = 50;
  int starts = 1;     ///< the scene's own numbers, then others around them, the same ones always
  double spread = 3;  ///< how far these go, in standard changes
  Cancelled cancelled;
};

/// What one start led to.
struct CalibrationStart {
  std::string name;  ///< "1", "2", "2, MCLa made taut"
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

/// `start`: of the scene's own numbers.
CalibrationSearch search(const CalibrationProblem& problem, const CalibrationSearchOptions& options,
                         const SolvableStart& start);

}  // namespace genu
