// LU of the matrix of many bodies, by blocks: bodies couple to few others, and the cost of a chain, of a ring, or of
// pieces around a bone grows with their number.
//
// A pivot is the whole block of a node (block_pattern.h), with rows exchanged inside it alone. Where that is not
// accurate enough, the dense matrix has to be factored.
#pragma once

#include <vector>

#include "genu/core/types.h"
#include "genu/equilibrium/block_pattern.h"

namespace genu {

class BlockLu {
 public:
  /// Factors a square matrix whose first 6 `bodies` rows and columns are the bodies'. Allocates only where other blocks
  /// have entries than in the matrix before. False where a block can be no pivot.
  [[nodiscard]] bool factor(const MatX& matrix, int bodies);

  /// After factor(); with one step of iterative refinement.
  void solve(const VecX& rhs, VecX& x);

  /// Estimate of the reciprocal condition in the 1-norm (N. J. Higham 1988, ACM TOMS 14:381), by a few solves.
  double rcond();

  /// Of a symmetric matrix: how many eigenvalues are negative. By Sylvester's law it is the sum over the pivots.
  int negative_eigenvalues() const;

 private:
  int nodes() const { return static_cast<int>(pattern_.rows.size()); }
  int size(int node) const { return static_cast<int>(pattern_.rows[at(node)].size()); }
  double* block(int row, int column) { return entries_.data() + first_[at(row * nodes() + column)]; }
  const double* block(int row, int column) const { return entries_.data() + first_[at(row * nodes() + column)]; }

  void allocate();
  void gather(const MatX& matrix);
  bool eliminate();
  void solve_once(VecX& v) const;
  void solve_transposed(VecX& v) const;
  void multiply(const VecX& x, VecX& out) const;

  Coupling coupling_;
  BlockPattern pattern_;
  std::vector<std::ptrdiff_t> first_;  ///< of each block among the entries; -1: zero
  std::vector<double> original_;       ///< the matrix, block by block, columns one after the other
  std::vector<double> entries_;        ///< its factors: pivots' LU, blocks left of them, pivot^-1 times those above
  std::vector<double> pivots_;         ///< the pivots themselves, one after the other
  std::vector<int> exchanged_;         ///< rows exchanged inside them
  std::vector<std::ptrdiff_t> first_pivot_, first_exchanged_;
  VecX work_, rest_, change_;
};

}  // namespace genu
