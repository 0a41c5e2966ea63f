#include "genu/equilibrium/scaled_solver.h"

#include "genu/equilibrium/tolerances.h"

namespace genu {

bool ScaledSolver::factor(const MatX& matrix, int bodies) {
  rank_ = matrix.rows();
  minimum_norm_ = surely_regular_ = by_blocks_ = false;
  if (matrix.rows() == 0) {
    rcond_ = 1;
    return true;
  }
  by_blocks_ = bodies >= kManyBodies && blocks_.factor(matrix, bodies);
  if (by_blocks_) {
    rcond_ = blocks_.rcond();
    by_blocks_ = rcond_ > kTrustLu;
  }
  if (by_blocks_) return true;
  rcond_ = small_.factor(matrix);
  surely_regular_ = rcond_ > kSurelyRegular;
  if (surely_regular_) return true;
  if (!matrix.allFinite()) return false;
  lu_.compute(matrix);
  // A pivot of exactly zero makes rcond() meaningless.
  const double smallest = lu_.matrixLU().diagonal().cwiseAbs().minCoeff();
  rcond_ = smallest > 0 ? lu_.rcond() : 0;
  if (rcond_ > kTrustLu) return true;
  minimum_norm_ = true;
  cod_.setThreshold(kRankThreshold);
  cod_.compute(matrix);
  rank_ = cod_.rank();
  return true;
}

void ScaledSolver::solve(const VecX& rhs, VecX& x) {
  if (rhs.size() == 0) {
    x.resize(0);
  } else if (by_blocks_) {
    blocks_.solve(rhs, x);
  } else if (surely_regular_) {
    small_.solve(rhs, x);
  } else if (minimum_norm_) {
    x = cod_.solve(rhs);
  } else {
    x = lu_.solve(rhs);
  }
}

}  // namespace genu
