#include "genu/equilibrium/feasible_direction.h"

#include <utility>
#include <vector>

#include "genu/core/decompositions.h"
#include "genu/equilibrium/tolerances.h"

namespace genu {
namespace {

/// The rows of norm 1; those without one are left out, for no motion comes to them.
MatX unit_rows(const MatX& rates) {
  MatX out(0, rates.cols());
  for (Eigen::Index i = 0; i < rates.rows(); ++i) {
    const double norm = rates.row(i).norm();
    if (norm < kBoundTolerance) continue;
    out.conservativeResize(out.rows() + 1, Eigen::NoChange);
    out.bottomRows<1>() = rates.row(i) / norm;
  }
  return out;
}

/// Minimises |A y - b| over y >= `least` by Lawson and Hanson (Solving Least Squares Problems, 1974, chapter 23), with
/// z = y - least >= 0. Each pass frees one weight and solves for all free ones. A weight that would fall below `least`
/// ends the step there and is fixed again.
class LeastSum {
 public:
  LeastSum(MatX columns, VecX aim, double least)
      : columns_(std::move(columns)),
        aim_(std::move(aim)),
        least_(least),
        y_(VecX::Constant(columns_.cols(), least)),
        raised_(static_cast<std::size_t>(columns_.cols()), false) {}

  /// |A y - b| decreases in every pass, so no set of free weights occurs twice. The limit guards against rounding.
  VecX solve() {
    const int most = 30 * static_cast<int>(y_.size());
    for (int pass = 0; pass < most && raise_one(); ++pass) settle();
    return y_;
  }

 private:
  using Set = std::vector<Eigen::Index>;

  Set raised() const {
    Set out;
    for (Eigen::Index i = 0; i < y_.size(); ++i)
      if (raised_[static_cast<std::size_t>(i)]) out.push_back(i);
    return out;
  }

  VecX sum() const { return columns_ * y_ - aim_; }

  /// Frees the weight with the steepest descent of the sum. False where none descends.
  bool raise_one() {
    const VecX now = sum();
    const double rounding = 1e-14 * (y_.lpNorm<1>() + aim_.norm());
    if (now.norm() <= rounding) return false;
    Eigen::Index best = -1;
    double least = -rounding;
    for (Eigen::Index i = 0; i < y_.size(); ++i)
      if (const double rate = columns_.col(i).dot(now); !raised_[static_cast<std::size_t>(i)] && rate < least) {
        least = rate;
        best = i;
      }
    if (best < 0) return false;
    raised_[static_cast<std::size_t>(best)] = true;
    return true;
  }

  /// Moves the free weights to the minimum of the sum, or towards it until one reaches `least`.
  void settle() {
    for (Set set = raised(); !set.empty(); set = raised()) {
      const VecX step = minimum_norm_solution(columns_(Eigen::all, set), -sum());
      double length = 1;
      Eigen::Index ends = -1;
      for (Eigen::Index k = 0; k < step.size(); ++k) {
        const double above = y_[set[static_cast<std::size_t>(k)]] - least_;
        if (above + length * step[k] > 0) continue;
        length = step[k] < 0 ? above / -step[k] : 0;
        ends = k;
      }
      for (Eigen::Index k = 0; k < step.size(); ++k) y_[set[static_cast<std::size_t>(k)]] += length * step[k];
      if (ends < 0) return;
      y_[set[static_cast<std::size_t>(ends)]] = least_;
      raised_[static_cast<std::size_t>(set[static_cast<std::size_t>(ends)])] = false;
    }
  }

  MatX columns_;
  VecX aim_;
  double least_;
  VecX y_;
  std::vector<bool> raised_;
};

}  // namespace

bool within(const MatX& bounds, const VecX& motion) {
  return bounds.rows() == 0 || (bounds * motion).maxCoeff() <= kBoundTolerance * motion.norm();
}

VecX feasible_direction(const MatX& bounds, const MatX& motions) {
  VecX none = VecX::Zero(motions.rows());
  const MatX rows = unit_rows(bounds * motions);
  if (rows.rows() == 0) return none;
  const VecX sum = rows.transpose() * LeastSum(rows.transpose(), VecX::Zero(rows.cols()), 1).solve();
  if (sum.norm() == 0) return none;
  const VecX way = -sum.normalized(), out = motions * way;
  return (rows * way).minCoeff() < -kDescentTolerance && within(bounds, out) ? out : none;
}

VecX interior_direction(const MatX& bounds, const MatX& motions) {
  VecX none = VecX::Zero(motions.rows());
  const MatX rows = unit_rows(bounds * motions);
  if (rows.rows() == 0) return motions.cols() > 0 ? VecX(motions.col(0)) : none;
  // Up to a factor, the point of their convex hull that is nearest to 0.
  MatX columns(rows.cols() + 1, rows.rows());
  columns << rows.transpose(), MatX::Ones(1, rows.rows());
  const VecX sum = rows.transpose() * LeastSum(columns, VecX::Unit(rows.cols() + 1, rows.cols()), 0).solve();
  if (sum.norm() == 0) return none;
  const VecX way = -sum.normalized();
  return (rows * way).maxCoeff() < -kBoundTolerance ? VecX(motions * way) : none;
}

VecX nonnegative_least_squares(const MatX& A, const VecX& b) { return LeastSum(A, b, 0).solve(); }

}  // namespace genu
