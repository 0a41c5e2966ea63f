// A linear solver that reports its accuracy: LU where the matrix is well conditioned, else the complete orthogonal
// decomposition. The minimum-norm step of the latter converges on parallel planes, line contact and spheres in sockets,
// where plain LU gives NaN. The matrix of many bodies is factored by blocks (block_lu.h) where that is accurate.
#pragma once

#include <Eigen/LU>
#include <Eigen/QR>

#include "genu/core/types.h"
#include "genu/equilibrium/block_lu.h"
#include "genu/equilibrium/small_lu.h"

namespace genu {

class ScaledSolver {
 public:
  /// Factors a square matrix whose first 6 `bodies` rows and columns are those of bodies. False when an entry is not
  /// finite.
  [[nodiscard]] bool factor(const MatX& matrix, int bodies = 0);
  void solve(const VecX& rhs, VecX& x);

  /// Reciprocal condition: an estimate from above; a lower bound where it is surely above kSurelyRegular and bodies are
  /// few.
  double rcond() const { return rcond_; }
  Eigen::Index rank() const { return rank_; }
  bool full_rank() const { return !minimum_norm_ || rank_ == cod_.cols(); }
  bool minimum_norm() const { return minimum_norm_; }

 private:
  SmallLu small_;
  BlockLu blocks_;
  Eigen::PartialPivLU<MatX> lu_;
  Eigen::CompleteOrthogonalDecomposition<MatX> cod_;
  double rcond_ = 0;
  Eigen::Index rank_ = 0;
  bool minimum_norm_ = false, surely_regular_ = false, by_blocks_ = false;
};

}  // namespace genu
