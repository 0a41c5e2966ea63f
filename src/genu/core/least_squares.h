// Least squares by Levenberg's and Marquardt's method: the step of the linearised problem, held back the more the less
// the linearisation has proved right (H. B. Nielsen 1999, IMM-REP-1999-05), each unknown in the measure of its column
// (J. J. More 1978).
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "genu/core/types.h"

namespace genu {

struct LeastSquaresProblem {
  /// Residuals at x, always as many; empty where there are none, as where a motion cannot be computed.
  std::function<std::optional<VecX>(const VecX& x)> residuals;
  /// Their derivatives at x; empty where there are none.
  std::function<std::optional<MatX>(const VecX& x)> jacobian;
  std::function<bool()> cancelled;  ///< may be empty
  /// Asked at the start and after each step that was taken, whether to stop at x; may be empty.
  std::function<bool(const VecX& x)> leave = {};
};

struct LeastSquaresOptions {
  int most_iterations = 50;
  double step_tolerance = 1e-8;        ///< of every unknown: steps below it are none
  double reduction_tolerance = 1e-10;  ///< of the sum of squares, promised by a step without damping
  double first_damping = 1e-3;         ///< of the largest square of a column
  double most_step = 1e300;            ///< of any unknown in one step
  /// The derivatives' own errors, beside the largest of them, all unknowns being of one measure: directions in which
  /// they are smaller are left alone. 0: only those without any.
  double noise = 0;
  VecX lower = {}, upper = {};  ///< bounds of the unknowns; empty: none
  VecX most_steps = {};         ///< of each unknown, in the place of most_step; empty: none
  /// After so many steps in a row with little gain, beside the sum of squares (kCreep) and beside what a step without
  /// damping promises (kCreepShare, kCreepPromise), the fit ends: it creeps along an edge. 0: never.
  int most_creeping = 0;
};

enum class LeastSquaresStop {
  small_step,   ///< the last step is below the tolerance: converged
  flat,         ///< no step would lower the sum of squares by more than the tolerance: converged
  no_progress,  ///< however short the step, the sum of squares does not fall
  creeping,     ///< step after step it hardly falls
  most_iterations,
  left,  ///< where LeastSquaresProblem::leave asked for it
  cancelled,
  no_start,  ///< no residuals at the start
  no_derivatives
};
const char* to_string(LeastSquaresStop stop);
inline bool converged(LeastSquaresStop s) { return s == LeastSquaresStop::small_step || s == LeastSquaresStop::flat; }

struct LeastSquaresResult {
  LeastSquaresStop stop = LeastSquaresStop::no_start;
  VecX x;          ///< the best seen
  VecX residuals;  ///< there
  MatX jacobian;   ///< of the last linearisation, which is that at x but for the last step
  int iterations = 0;
  int trials = 0;  ///< residuals asked for, without those of derivatives
};

LeastSquaresResult least_squares(const LeastSquaresProblem& problem, const VecX& start,
                                 const LeastSquaresOptions& options = {});

/// What residuals say of the unknowns, each residual being as uncertain as the others.
struct LeastSquaresUncertainty {
  VecX deviation;    ///< standard deviation of each unknown; infinite where the residuals do not determine it
  MatX correlation;  ///< of the unknowns that are determined; 0 beside others, 1 on the diagonal
  /// Directions, each of length 1, along which the residuals do not change: the largest share of each is positive.
  std::vector<VecX> undetermined;
  MatX covariance;  ///< of all unknowns, within the directions that are determined
};

/// `noise`: singular values of the derivatives below this share of the largest are none, because their own errors are
/// as large. `variance` of a residual: where it is not given, that of the residuals; without more residuals than
/// unknowns deviations are infinite then.
LeastSquaresUncertainty least_squares_uncertainty(const MatX& jacobian, const VecX& residuals, double noise,
                                                  std::optional<double> variance = {});

}  // namespace genu
