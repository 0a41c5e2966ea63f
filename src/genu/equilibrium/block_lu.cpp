#include "genu/equilibrium/block_lu.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "genu/core/decompositions.h"
#include "genu/equilibrium/tolerances.h"

namespace genu {
namespace {

/// LU in place with rows exchanged, n x n, columns one after the other. False for a pivot of 0 or no number.
bool factor_block(int n, double* a, int* exchanged) {
  for (int k = 0; k < n; ++k) {
    double* column = a + static_cast<std::ptrdiff_t>(k) * n;
    int p = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(column[i]) > std::abs(column[p])) p = i;
    exchanged[k] = p;
    if (p != k)
      for (int j = 0; j < n; ++j) std::swap(a[j * n + k], a[j * n + p]);
    const double inverse = 1 / column[k];
    if (!std::isfinite(inverse)) return false;
    for (int i = k + 1; i < n; ++i) column[i] *= inverse;
    for (int j = k + 1; j < n; ++j) {
      double* to = a + static_cast<std::ptrdiff_t>(j) * n;
      for (int i = k + 1; i < n; ++i) to[i] -= column[i] * to[k];
    }
  }
  return true;
}

/// Bodies without further rows, which most are, have loops of known length.
template <typename Size>
void solve_block_of(Size n, const double* a, const int* exchanged, double* v) {
  for (int k = 0; k < n; ++k) std::swap(v[k], v[exchanged[k]]);
  for (int k = 0; k < n; ++k)
    for (int i = k + 1; i < n; ++i) v[i] -= a[k * n + i] * v[k];
  for (int k = n - 1; k >= 0; --k) {
    v[k] /= a[k * n + k];
    for (int i = 0; i < k; ++i) v[i] -= a[k * n + i] * v[k];
  }
}

void solve_block(int n, const double* a, const int* exchanged, double* v) {
  if (n == 6)
    solve_block_of(std::integral_constant<int, 6>(), a, exchanged, v);
  else
    solve_block_of(n, a, exchanged, v);
}

void solve_block_transposed(int n, const double* a, const int* exchanged, double* v) {
  for (int k = 0; k < n; ++k) {
    for (int i = 0; i < k; ++i) v[k] -= a[k * n + i] * v[i];
    v[k] /= a[k * n + k];
  }
  for (int k = n - 1; k >= 0; --k)
    for (int i = k + 1; i < n; ++i) v[k] -= a[k * n + i] * v[i];
  for (int k = n - 1; k >= 0; --k) std::swap(v[k], v[exchanged[k]]);
}

template <typename Size>
void add_product_of(Size m, Size n, double factor, const double* a, const double* x, double* out) {
  for (int j = 0; j < n; ++j) {
    const double by = factor * x[j];
    for (int i = 0; i < m; ++i) out[i] += a[j * m + i] * by;
  }
}

/// out += factor A x, A m x n.
void add_product(int m, int n, double factor, const double* a, const double* x, double* out) {
  using Six = std::integral_constant<int, 6>;
  if (m == 6 && n == 6)
    add_product_of(Six(), Six(), factor, a, x, out);
  else
    add_product_of(m, n, factor, a, x, out);
}

/// out -= A^T x, A m x n.
void subtract_transposed_product(int m, int n, const double* a, const double* x, double* out) {
  for (int j = 0; j < n; ++j) {
    double sum = 0;
    for (int i = 0; i < m; ++i) sum += a[j * m + i] * x[i];
    out[j] -= sum;
  }
}

double largest_of(const double* a, int count) {
  double out = 0;
  for (int i = 0; i < count; ++i) out = std::max(out, std::abs(a[i]));
  return out;
}

/// A vector's entries of one node, taken from where they stand among the matrix's rows.
void take_rows(const std::vector<int>& rows, const VecX& from, double* out) {
  for (std::size_t i = 0; i < rows.size(); ++i) out[i] = from[rows[i]];
}

}  // namespace

void BlockLu::allocate() {
  pattern_ = block_pattern(coupling_);
  const int n = nodes();
  first_.assign(at(n) * at(n), -1);
  first_pivot_.clear();
  first_exchanged_.clear();
  std::ptrdiff_t entries = 0, pivots = 0, rows = 0;
  const auto place = [&](int row, int column) {
    first_[at(row * n + column)] = entries;
    entries += static_cast<std::ptrdiff_t>(size(row)) * size(column);
  };
  for (int a = 0; a < n; ++a) {
    place(a, a);
    for (const int b : pattern_.later[at(a)]) {
      place(a, b);
      place(b, a);
    }
    first_pivot_.push_back(pivots);
    first_exchanged_.push_back(rows);
    pivots += static_cast<std::ptrdiff_t>(size(a)) * size(a);
    rows += size(a);
  }
  entries_.resize(static_cast<std::size_t>(entries));
  original_.resize(static_cast<std::size_t>(entries));
  pivots_.resize(static_cast<std::size_t>(pivots));
  exchanged_.resize(static_cast<std::size_t>(rows));
  for (VecX* v : {&work_, &rest_, &change_}) v->resize(rows);
}

void BlockLu::gather(const MatX& matrix) {
  const int n = nodes();
  for (int column = 0; column < n; ++column)
    for (int row = 0; row < n; ++row) {
      std::ptrdiff_t next = first_[at(row * n + column)];
      if (next < 0) continue;
      for (const int j : pattern_.rows[at(column)])
        for (const int i : pattern_.rows[at(row)]) original_[static_cast<std::size_t>(next++)] = matrix(i, j);
    }
  entries_ = original_;
}

bool BlockLu::eliminate() {
  for (int v = 0; v < nodes(); ++v) {
    const int n = size(v);
    double *pivot = block(v, v), *kept = pivots_.data() + first_pivot_[at(v)];
    int* exchanged = exchanged_.data() + first_exchanged_[at(v)];
    std::copy_n(pivot, n * n, kept);
    const double before = largest_of(original_.data() + first_[at(v * nodes() + v)], n * n);
    const double largest = largest_of(kept, n * n);
    if (!(largest <= kLargestGrowth * before) || !factor_block(n, pivot, exchanged)) return false;
    for (int k = 0; k < n; ++k)
      if (!(std::abs(pivot[k * n + k]) > kLeastBlockPivot * largest)) return false;
    for (const int b : pattern_.later[at(v)]) {
      double* above = block(v, b);
      for (int j = 0; j < size(b); ++j) solve_block(n, pivot, exchanged, above + static_cast<std::ptrdiff_t>(j) * n);
      for (const int a : pattern_.later[at(v)]) {
        const int m = size(a);
        const double* left = block(a, v);
        double* to = block(a, b);
        for (int j = 0; j < size(b); ++j)
          add_product(m, n, -1, left, above + static_cast<std::ptrdiff_t>(j) * n,
                      to + static_cast<std::ptrdiff_t>(j) * m);
      }
    }
  }
  return true;
}

bool BlockLu::factor(const MatX& matrix, int bodies) {
  const int others = static_cast<int>(matrix.rows()) - 6 * bodies;
  if (coupling_.bodies() != bodies || coupling_.groups() != bodies + others) coupling_ = Coupling(bodies, others);
  if (coupling_.look_at(matrix)) allocate();
  gather(matrix);
  return eliminate();
}

void BlockLu::solve_once(VecX& v) const {
  // In the order of the nodes: their entries stand one after the other.
  double* y = v.data();
  for (int k = 0; k < nodes(); ++k) {
    double* own = y + first_exchanged_[at(k)];
    solve_block(size(k), block(k, k), exchanged_.data() + first_exchanged_[at(k)], own);
    for (const int a : pattern_.later[at(k)])
      add_product(size(a), size(k), -1, block(a, k), own, y + first_exchanged_[at(a)]);
  }
  for (int k = nodes() - 1; k >= 0; --k)
    for (const int b : pattern_.later[at(k)])
      add_product(size(k), size(b), -1, block(k, b), y + first_exchanged_[at(b)], y + first_exchanged_[at(k)]);
}

void BlockLu::solve_transposed(VecX& v) const {
  double* y = v.data();
  for (int k = 0; k < nodes(); ++k)
    for (const int b : pattern_.later[at(k)])
      subtract_transposed_product(size(k), size(b), block(k, b), y + first_exchanged_[at(k)],
                                  y + first_exchanged_[at(b)]);
  for (int k = nodes() - 1; k >= 0; --k) {
    double* own = y + first_exchanged_[at(k)];
    for (const int a : pattern_.later[at(k)])
      subtract_transposed_product(size(a), size(k), block(a, k), y + first_exchanged_[at(a)], own);
    solve_block_transposed(size(k), block(k, k), exchanged_.data() + first_exchanged_[at(k)], own);
  }
}

/// With the matrix itself, both vectors in the order of the nodes.
void BlockLu::multiply(const VecX& x, VecX& out) const {
  out.setZero();
  const auto add = [&](int row, int column) {
    add_product(size(row), size(column), 1, original_.data() + first_[at(row * nodes() + column)],
                x.data() + first_exchanged_[at(column)], out.data() + first_exchanged_[at(row)]);
  };
  for (int k = 0; k < nodes(); ++k) {
    add(k, k);
    for (const int b : pattern_.later[at(k)]) {
      add(k, b);
      add(b, k);
    }
  }
}

void BlockLu::solve(const VecX& rhs, VecX& x) {
  for (int k = 0; k < nodes(); ++k) take_rows(pattern_.rows[at(k)], rhs, work_.data() + first_exchanged_[at(k)]);
  change_ = work_;
  solve_once(change_);
  multiply(change_, rest_);
  rest_ = work_ - rest_;
  solve_once(rest_);
  change_ += rest_;
  x.resize(rhs.size());
  for (int k = 0; k < nodes(); ++k)
    for (int i = 0; i < size(k); ++i) x[pattern_.rows[at(k)][at(i)]] = change_[first_exchanged_[at(k)] + i];
}

double BlockLu::rcond() {
  double norm = 0;
  change_.setZero();
  for (int column = 0; column < nodes(); ++column)
    for (int row = 0; row < nodes(); ++row) {
      const std::ptrdiff_t first = first_[at(row * nodes() + column)];
      for (int k = 0; first >= 0 && k < size(row) * size(column); ++k)
        change_[first_exchanged_[at(column)] + k / size(row)] +=
            std::abs(original_[static_cast<std::size_t>(first + k)]);
    }
  norm = change_.maxCoeff();
  const auto n = static_cast<double>(work_.size());
  work_.setConstant(1 / n);
  double inverse = 0;
  Eigen::Index last = -1;
  for (int i = 0; i < kConditionSolves; ++i) {
    solve_once(work_);
    const double sum = work_.cwiseAbs().sum();
    if (i > 0 && !(sum > inverse)) break;
    inverse = sum;
    rest_ = work_.unaryExpr([](double x) { return x < 0 ? -1.0 : 1.0; });
    solve_transposed(rest_);
    Eigen::Index largest = 0;
    rest_.cwiseAbs().maxCoeff(&largest);
    if (largest == last) break;
    last = largest;
    work_.setZero();
    work_[largest] = 1;
  }
  // A vector that alternates and grows finds what cancels for those.
  for (Eigen::Index i = 0; i < work_.size(); ++i)
    work_[i] = (i % 2 == 0 ? 1 : -1) * (1 + static_cast<double>(i) / std::max(1.0, n - 1));
  solve_once(work_);
  inverse = std::max(inverse, 2 * work_.cwiseAbs().sum() / (3 * n));
  const double product = norm * inverse;
  return product > 0 && std::isfinite(product) ? 1 / product : 0;
}

int BlockLu::negative_eigenvalues() const {
  int out = 0;
  for (int k = 0; k < nodes(); ++k) {
    const Eigen::Map<const MatX> pivot(pivots_.data() + first_pivot_[at(k)], size(k), size(k));
    const VecX values = symmetric_eigen(MatX(pivot)).values;
    out += static_cast<int>((values.array() < 0).count());
  }
  return out;
}

}  // namespace genu
