#include "genu/solver/small_lu.h"

#include <algorithm>
#include <cmath>

namespace genu {

bool SmallLu::eliminate() {
  for (int k = 0; k < n_; ++k) {
    double* pivot_column = column(k);
    int p = k;
    for (int i = k + 1; i < n_; ++i)
      if (std::abs(pivot_column[i]) > std::abs(pivot_column[p])) p = i;
    pivots_[at(k)] = p;
    if (p != k)
      for (int j = 0; j < n_; ++j) std::swap(column(j)[k], column(j)[p]);
    const double inverse = 1 / pivot_column[k];
    if (!std::isfinite(inverse)) return false;
    inverse_[at(k)] = inverse;
    for (int i = k + 1; i < n_; ++i) pivot_column[i] *= inverse;
    for (int j = k + 1; j < n_; ++j) {
      double* to = column(j);
      const double factor = to[k];
      if (factor == 0) continue;
      for (int i = k + 1; i < n_; ++i) to[i] -= factor * pivot_column[i];
    }
  }
  return true;
}

/// For P A = L U: the largest row sum of |U^-1| |L^-1| is at most that of the inverses of the triangles with the signs
/// of all entries off the diagonal turned to minus, which one solve finds (Higham, Accuracy and Stability of Numerical
/// Algorithms, 2002, section 8.3).
double SmallLu::largest_of_inverse() {
  std::fill(bound_.begin(), bound_.end(), 1.0);
  double* b = bound_.data();
  for (int j = 0; j < n_; ++j) {
    const double* l = column(j);
    for (int i = j + 1; i < n_; ++i) b[i] += b[j] * std::abs(l[i]);
  }
  double largest = 0;
  for (int j = n_ - 1; j >= 0; --j) {
    const double* u = column(j);
    b[j] *= std::abs(inverse_[at(j)]);
    for (int i = 0; i < j; ++i) b[i] += b[j] * std::abs(u[i]);
    largest = std::max(largest, b[j]);
  }
  return largest;
}

double SmallLu::factor(const MatX& matrix) {
  n_ = static_cast<int>(matrix.rows());
  entries_.assign(matrix.data(), matrix.data() + matrix.size());
  inverse_.resize(at(n_));
  bound_.resize(at(n_));
  pivots_.resize(at(n_));
  std::fill(bound_.begin(), bound_.end(), 0.0);
  for (int j = 0; j < n_; ++j)
    for (int i = 0; i < n_; ++i) bound_[at(i)] += std::abs(column(j)[i]);
  double largest = 0;
  for (const double row : bound_) {
    if (!std::isfinite(row)) return 0;
    largest = std::max(largest, row);
  }
  if (!eliminate()) return 0;
  const double product = largest * largest_of_inverse();
  return product > 0 && std::isfinite(product) ? 1 / product : 0;
}

void SmallLu::solve(const VecX& rhs, VecX& x) const {
  x = rhs;
  double* v = x.data();
  for (int k = 0; k < n_; ++k) {
    if (pivots_[at(k)] != k) std::swap(v[k], v[pivots_[at(k)]]);
  }
  for (int k = 0; k < n_; ++k) {
    const double* l = column(k);
    for (int i = k + 1; i < n_; ++i) v[i] -= v[k] * l[i];
  }
  for (int k = n_ - 1; k >= 0; --k) {
    const double* u = column(k);
    v[k] *= inverse_[at(k)];
    for (int i = 0; i < k; ++i) v[i] -= v[k] * u[i];
  }
}

}  // namespace genu
