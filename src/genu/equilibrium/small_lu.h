// LU with partial pivoting for matrices of the size of a Newton step, where a blocked LU is slower. Also gives a lower
// bound of the reciprocal condition for the cost of one more solve.
#pragma once

#include <vector>

#include "genu/core/types.h"

namespace genu {

class SmallLu {
 public:
  /// Factors a square matrix. Returns a lower bound of its reciprocal condition (infinity norm), or 0 where none is
  /// known.
  double factor(const MatX& matrix);

  /// After factor() > 0.
  void solve(const VecX& rhs, VecX& x) const;

 private:
  bool eliminate();
  template <int kRows>
  bool eliminate_rows();
  double largest_of_inverse();
  double* column(int j) { return entries_.data() + static_cast<std::ptrdiff_t>(j) * n_; }
  const double* column(int j) const { return entries_.data() + static_cast<std::ptrdiff_t>(j) * n_; }

  int n_ = 0;
  std::vector<double> entries_;  // L below the diagonal, which is 1, and U
  std::vector<double> inverse_;  // of the pivots
  std::vector<double> bound_, below_;
  std::vector<int> pivots_;
};

}  // namespace genu
