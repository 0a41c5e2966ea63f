#include "genu/solver/scaled_solver.h"

#include <algorithm>
#include <cmath>

namespace genu {

/// For P A = L U: the largest row sum of |U^-1| |L^-1| is at most that of the inverses of the triangles with the signs
/// of all entries off the diagonal turned to minus, which one solve finds (Higham, Accuracy and Stability of Numerical
/// Algorithms, 2002, section 8.3).
double ScaledSolver::rcond_at_least(const MatX& matrix) {
  const MatX& lu = lu_.matrixLU();
  const Eigen::Index n = lu.rows();
  bound_.setOnes(n);
  for (Eigen::Index j = 0; j < n; ++j) bound_.tail(n - j - 1) += bound_[j] * lu.col(j).tail(n - j - 1).cwiseAbs();
  for (Eigen::Index j = n - 1; j >= 0; --j) {
    bound_[j] /= std::abs(lu(j, j));
    bound_.head(j) += bound_[j] * lu.col(j).head(j).cwiseAbs();
  }
  const double product = matrix.cwiseAbs().rowwise().sum().maxCoeff() * bound_.maxCoeff();
  return std::isfinite(product) && bound_.allFinite() ? 1 / product : 0;
}

bool ScaledSolver::factor(const MatX& matrix) {
  if (!matrix.allFinite()) return false;
  rank_ = matrix.rows();
  minimum_norm_ = false;
  if (matrix.rows() == 0) {
    rcond_ = 1;
    return true;
  }
  lu_.compute(matrix);
  rcond_ = rcond_at_least(matrix);
  if (rcond_ > kSurelyRegular) return true;
  // A pivot that is exactly zero makes rcond() meaningless.
  const double smallest = lu_.matrixLU().diagonal().cwiseAbs().minCoeff();
  rcond_ = smallest > 0 ? lu_.rcond() : 0;
  if (rcond_ > kTrustLu) return true;
  minimum_norm_ = true;
  cod_.setThreshold(kRankThreshold);
  cod_.compute(matrix);
  rank_ = cod_.rank();
  return true;
}

void ScaledSolver::solve(const VecX& rhs, VecX& x) const {
  if (rhs.size() == 0) {
    x.resize(0);
  } else if (minimum_norm_) {
    x = cod_.solve(rhs);
  } else {
    x = lu_.solve(rhs);
  }
}

}  // namespace genu
