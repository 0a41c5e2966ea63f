// A linear solver that reports its accuracy: LU where the matrix is well conditioned, else the complete orthogonal
// decomposition. The minimum-norm step of the latter converges on parallel planes, line contact and spheres in sockets,
// where plain LU gives NaN.
#pragma once

#include <Eigen/LU>
#include <Eigen/QR>

#include "genu/core/types.h"
#include "genu/equilibrium/small_lu.h"

namespace genu {

class ScaledSolver {
 public:
  /// Factors a square matrix. False when an entry is not finite.
  [[nodiscard]] bool factor(const MatX& matrix);
  void solve(const VecX& rhs, VecX& x) const;

  /// Reciprocal condition. Where it is surely above kSurelyRegular, a lower bound of it.
  double rcond() const { return rcond_; }
  Eigen::Index rank() const { return rank_; }
  bool full_rank() const { return !minimum_norm_ || rank_ == cod_.cols(); }
  bool minimum_norm() const { return minimum_norm_; }

 private:
  SmallLu small_;
  Eigen::PartialPivLU<MatX> lu_;
  Eigen::CompleteOrthogonalDecomposition<MatX> cod_;
  double rcond_ = 0;
  Eigen::Index rank_ = 0;
  bool minimum_norm_ = false, surely_regular_ = false;
};

}  // namespace genu
