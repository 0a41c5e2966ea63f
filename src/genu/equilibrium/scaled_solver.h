// A linear solve that says what it is worth: LU where the matrix is well conditioned, else the complete orthogonal
// decomposition, whose minimum-norm step converges on parallel planes, line contact and spheres in sockets, where plain
// LU gives NaN.
#pragma once

#include <Eigen/LU>
#include <Eigen/QR>

#include "genu/core/types.h"
#include "genu/equilibrium/small_lu.h"

namespace genu {

class ScaledSolver {
 public:
  /// Below this reciprocal condition (matrix in scaled units) LU gives way to the complete orthogonal decomposition.
  /// Two contacts a tenth of a millimetre apart on a real knee reach 1e-12 and LU still solves them to rounding, where
  /// the truncated decomposition leaves a gap of 0.05 nm standing; parallel planes are at 1e-17.
  static constexpr double kTrustLu = 1e-15;
  /// Above this nobody asks how large it is.
  static constexpr double kSurelyRegular = 1e-12;
  /// Pivots below this fraction of the largest count as zero there. 1e-6 or more is known to stall Newton.
  static constexpr double kRankThreshold = 1e-10;

  /// Factors a square matrix. False when it holds anything that is not finite.
  bool factor(const MatX& matrix);
  void solve(const VecX& rhs, VecX& x) const;

  /// Reciprocal condition; where it is surely above kSurelyRegular, a lower bound of it.
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
