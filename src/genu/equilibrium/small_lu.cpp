#include "genu/equilibrium/small_lu.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace genu {
namespace {

/// Number of rows where the compiler knows it, so that loops over a column are unrolled; else 0.
template <int kRows>
using Rows = std::integral_constant<int, kRows>;

/// Sizes of one body with one to five constraints and contacts; all others share one version.
template <typename Work>
auto with_rows(int n, const Work& work) {
  switch (n) {
    case 7:
      return work(Rows<7>());
    case 8:
      return work(Rows<8>());
    case 9:
      return work(Rows<9>());
    case 10:
      return work(Rows<10>());
    case 11:
      return work(Rows<11>());
    default:
      return work(Rows<0>());
  }
}

template <int kRows>
void solve_in_place(int rows, const double* columns, const double* inverse, double* out) {
  const int n = kRows > 0 ? kRows : rows;
  constexpr int kLocal = kRows > 0 ? kRows : 1;
  double local[kLocal];
  double* v = kRows > 0 ? local : out;
  if constexpr (kRows > 0) std::copy_n(out, kRows, local);
#pragma GCC unroll 11
  for (int k = 0; k < n; ++k) {
    const double factor = v[k];
#pragma GCC unroll 11
    for (int i = k + 1; i < n; ++i) v[i] -= factor * columns[k * n + i];
  }
#pragma GCC unroll 11
  for (int k = n - 1; k >= 0; --k) {
    const double factor = v[k] *= inverse[k];
#pragma GCC unroll 11
    for (int i = 0; i < k; ++i) v[i] -= factor * columns[k * n + i];
  }
  if constexpr (kRows > 0) std::copy_n(local, kRows, out);
}

/// For P A = L U: the infinity norm of |U^-1| |L^-1| is at most that of the inverses of the comparison matrices
/// (off-diagonal entries made negative), which one solve gives (Higham, Accuracy and Stability of Numerical Algorithms,
/// 2002, section 8.3).
template <int kRows>
double largest_row_sum(int rows, const double* columns, const double* inverse, double* memory) {
  const int n = kRows > 0 ? kRows : rows;
  constexpr int kLocal = kRows > 0 ? kRows : 1;
  double local[kLocal];
  double* b = kRows > 0 ? local : memory;
  std::fill_n(b, n, 1.0);
#pragma GCC unroll 11
  for (int j = 0; j < n; ++j)
#pragma GCC unroll 11
    for (int i = j + 1; i < n; ++i) b[i] += b[j] * std::abs(columns[j * n + i]);
  double largest = 0, sum = 0;
#pragma GCC unroll 11
  for (int j = n - 1; j >= 0; --j) {
    b[j] *= std::abs(inverse[j]);
#pragma GCC unroll 11
    for (int i = 0; i < j; ++i) b[i] += b[j] * std::abs(columns[j * n + i]);
    largest = std::max(largest, b[j]);
    sum += b[j];
  }
  return std::isfinite(sum) ? largest : sum;  // std::max() drops a NaN
}

/// Subtracts `factor` times the scaled entries below a pivot from column `to`. Rows above the pivot do not change.
template <int kRows>
void subtract_below(int rows, int pivot, const double* below, double* to) {
  const double factor = to[pivot];
  const int n = kRows > 0 ? kRows : rows;
  for (int i = kRows > 0 ? 0 : pivot + 1; i < n; ++i) to[i] -= factor * below[i];
}

}  // namespace

bool SmallLu::eliminate() {
  return with_rows(n_, [this](auto rows) { return eliminate_rows<rows()>(); });
}

template <int kRows>
bool SmallLu::eliminate_rows() {
  below_.assign(at(n_), 0.0);
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
    below_[at(k)] = 0;
    for (int i = k + 1; i < n_; ++i) below_[at(i)] = pivot_column[i] *= inverse;
    for (int j = k + 1; j < n_; ++j) subtract_below<kRows>(n_, k, below_.data(), column(j));
  }
  return true;
}

double SmallLu::largest_of_inverse() {
  return with_rows(
      n_, [this](auto rows) { return largest_row_sum<rows()>(n_, column(0), inverse_.data(), bound_.data()); });
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
  with_rows(n_, [&](auto rows) { solve_in_place<rows()>(n_, column(0), inverse_.data(), v); });
}

}  // namespace genu
