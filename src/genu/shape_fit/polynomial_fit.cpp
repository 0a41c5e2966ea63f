#include "genu/shape_fit/polynomial_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "genu/core/decompositions.h"
#include "genu/shape_fit/tolerances.h"

namespace genu {
namespace {

using Index = Eigen::Index;

Index column_count(int degree) { return (degree + 1) * (degree + 2) / 2; }

/// Calls use(i, j) for the exponents in the order of the columns: by total degree, then by the power of v.
template <class Use>
void for_each_column(int degree, const Use& use) {
  for (int d = 0; d <= degree; ++d)
    for (int j = 0; j <= d; ++j) use(d - j, j);
}

/// P_0 .. P_n at x by the three-term recurrence.
void legendre(int n, double x, double* P) {
  P[0] = 1;
  if (n > 0) P[1] = x;
  for (int k = 1; k < n; ++k) P[k + 1] = ((2 * k + 1) * x * P[k] - k * P[k - 1]) / (k + 1);
}

/// Coefficients of P_k((x - middle) / half) in powers of x, for all k up to n: row k.
std::vector<std::vector<double>> legendre_powers(int n, double middle, double half) {
  std::vector<std::vector<double>> rows(static_cast<std::size_t>(n) + 1);
  const auto times_argument = [&](const std::vector<double>& p) {
    std::vector<double> out(p.size() + 1, 0.0);
    for (std::size_t i = 0; i < p.size(); ++i) out[i] -= middle / half * p[i], out[i + 1] += p[i] / half;
    return out;
  };
  rows[0] = {1};
  if (n > 0) rows[1] = times_argument(rows[0]);
  for (std::size_t k = 1; k < static_cast<std::size_t>(n); ++k) {
    const auto kk = static_cast<double>(k);
    rows[k + 1] = times_argument(rows[k]);
    for (double& c : rows[k + 1]) c *= (2 * kk + 1) / (kk + 1);
    for (std::size_t i = 0; i < rows[k - 1].size(); ++i) rows[k + 1][i] -= kk / (kk + 1) * rows[k - 1][i];
  }
  return rows;
}

}  // namespace

PolynomialFit::PolynomialFit(const std::vector<HeightSample>& samples, const ChartBox& box, int highest)
    : samples_(samples), box_(box) {
  highest = std::min(highest, kHighestFitDegree);
  const auto rows = static_cast<Index>(samples.size());
  while (highest >= 0 && column_count(highest) * kSamplesForEach > rows) --highest;
  if (highest < 0 || !(box.width() > 0) || !(box.height() > 0)) return;
  MatX A(rows, column_count(highest));
  right_.resize(rows);
  std::vector<double> U(static_cast<std::size_t>(highest) + 1), V(U.size());
  for (Index k = 0; k < rows; ++k) {
    const HeightSample& s = samples[static_cast<std::size_t>(k)];
    const double root = std::sqrt(s.weight);
    legendre(highest, (2 * s.u - box.u0 - box.u1) / box.width(), U.data());
    legendre(highest, (2 * s.v - box.v0 - box.v1) / box.height(), V.data());
    Index column = 0;
    for_each_column(highest, [&](int i, int j) {
      A(k, column++) = root * U[static_cast<std::size_t>(i)] * V[static_cast<std::size_t>(j)];
    });
    right_(k) = root * s.h;
    weight_ += s.weight;
  }
  const VecX lengths = A.colwise().norm();
  ThinQr qr = thin_qr(A);
  Q_ = std::move(qr.Q);
  R_ = std::move(qr.R);
  Qh_ = Q_.transpose() * right_;
  const auto determined = [&](int degree) {
    for (Index c = 0; c < column_count(degree); ++c)
      if (!(std::abs(R_(c, c)) > kIndependentColumn * lengths(c))) return false;
    return true;
  };
  while (highest >= 0 && !determined(highest)) --highest;
  highest_ = highest;
}

std::vector<PolynomialTerm> PolynomialFit::terms(int degree) const {
  const Index n = column_count(degree);
  const VecX c = solve_upper(R_.topLeftCorner(n, n), Qh_.head(n));
  const auto U = legendre_powers(degree, 0.5 * (box_.u0 + box_.u1), 0.5 * box_.width()),
             V = legendre_powers(degree, 0.5 * (box_.v0 + box_.v1), 0.5 * box_.height());
  const auto size = static_cast<std::size_t>(degree) + 1;
  std::vector<double> powers(size * size, 0.0);
  Index column = 0;
  for_each_column(degree, [&](int i, int j) {
    const auto &p = U[static_cast<std::size_t>(i)], &q = V[static_cast<std::size_t>(j)];
    for (std::size_t a = 0; a < p.size(); ++a)
      for (std::size_t b = 0; b < q.size(); ++b) powers[a * size + b] += c(column) * p[a] * q[b];
    ++column;
  });
  std::vector<PolynomialTerm> out;
  const double u = std::max(std::abs(box_.u0), std::abs(box_.u1)), v = std::max(std::abs(box_.v0), std::abs(box_.v1));
  for_each_column(degree, [&](int i, int j) {
    const double p = powers[static_cast<std::size_t>(i) * size + static_cast<std::size_t>(j)];
    const bool matters = std::abs(p) * std::pow(u, i) * std::pow(v, j) > kNoTerm;
    out.push_back({i, j, matters ? p : 0.0});
  });
  return out;
}

double PolynomialFit::rms(int degree) const {
  const Index n = column_count(degree);
  return std::sqrt((right_ - Q_.leftCols(n) * Qh_.head(n)).squaredNorm() / weight_);
}

std::vector<DegreeScore> PolynomialFit::scores(int lowest, double block_u, double block_v) const {
  if (highest_ < lowest) return {};
  std::vector<DegreeScore> out;
  std::vector<std::vector<Index>> folds(kFolds);
  for (std::size_t k = 0; k < samples_.size(); ++k) {
    const HeightSample& s = samples_[k];
    const auto column = static_cast<long>(std::floor((s.u - box_.u0) / block_u)),
               row = static_cast<long>(std::floor((s.v - box_.v0) / block_v));
    // Steps of 1 and 3 over ten folds: blocks of a fold lie apart in every direction.
    const long fold = ((column + 3 * row) % kFolds + kFolds) % kFolds;
    folds[static_cast<std::size_t>(fold)].push_back(static_cast<Index>(k));
  }
  for (int d = lowest; d <= highest_; ++d) out.push_back({d, 0, rms(d)});
  for (const std::vector<Index>& fold : folds) {
    if (fold.empty()) continue;
    const MatX Qb = Q_(fold, Eigen::all);
    const VecX hb = right_(fold);
    // Without the block the normal equations in the orthonormal columns are I - Qb^T Qb.
    const MatX G = MatX::Identity(Qb.cols(), Qb.cols()) - Qb.transpose() * Qb;
    const VecX g = Qh_ - Qb.transpose() * hb;
    for (DegreeScore& score : out) {
      const Index n = column_count(score.degree);
      const VecX c = definite_solution(G.topLeftCorner(n, n), g.head(n));
      const double square = (hb - Qb.leftCols(n) * c).squaredNorm();
      score.left_out_rms += std::isfinite(square) ? square : std::numeric_limits<double>::infinity();
    }
  }
  for (DegreeScore& score : out) score.left_out_rms = std::sqrt(score.left_out_rms / weight_);
  return out;
}

int exact_degree(const PolynomialFit& fit, double resolution) {
  if (fit.highest() < kLowestFitDegree || !(fit.rms(fit.highest()) <= resolution)) return -1;
  int degree = kLowestFitDegree;
  while (fit.rms(degree) > kSameResidual * fit.rms(fit.highest()) + kFitRounding) ++degree;
  return degree;
}

int choose_degree(const std::vector<DegreeScore>& scores, double floor) {
  if (scores.empty()) return -1;
  double best = std::numeric_limits<double>::infinity();
  for (const DegreeScore& s : scores) best = std::min(best, s.left_out_rms);
  for (const DegreeScore& s : scores)
    if (s.left_out_rms <= kAsGoodScore * best + floor) return s.degree;
  return scores.back().degree;
}

}  // namespace genu
