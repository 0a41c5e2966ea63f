#include "genu/solver/way_out.h"

#include <vector>

#include "genu/core/decompositions.h"

namespace genu {
namespace {

constexpr double kPressed = 1e-9;  // what a motion of unit norm exceeds a bound by less is rounding
constexpr double kLeft = 1e-6;     // what it leaves none by more than this is no way out

/// The rows of norm 1; those without one are left out, for no motion comes to them.
MatX unit_rows(const MatX& rates) {
  MatX out(0, rates.cols());
  for (Eigen::Index i = 0; i < rates.rows(); ++i) {
    const double norm = rates.row(i).norm();
    if (norm < kPressed) continue;
    out.conservativeResize(out.rows() + 1, Eigen::NoChange);
    out.bottomRows<1>() = rates.row(i) / norm;
  }
  return out;
}

/// The weights y >= 1 of the rows of R (k x m, of norm 1) for which |R^T y| is least: Lawson and Hanson (1974), Solving
/// least squares problems, chapter 23, for z = y - 1 >= 0. Each pass raises one weight and solves for all that are
/// raised; one that would fall below 1 ends the step there and is 1 again.
class LeastSum {
 public:
  explicit LeastSum(const MatX& rows)
      : columns_(rows.transpose()),
        y_(VecX::Ones(rows.rows())),
        raised_(static_cast<std::size_t>(rows.rows()), false) {}

  /// |R^T y| falls with every pass, so that no set of raised weights comes twice; the limit is for rounding.
  VecX solve() {
    const int most = 30 * static_cast<int>(y_.size());
    for (int pass = 0; pass < most && raise_one(); ++pass) settle();
    return columns_ * y_;
  }

 private:
  using Set = std::vector<Eigen::Index>;

  Set raised() const {
    Set out;
    for (Eigen::Index i = 0; i < y_.size(); ++i)
      if (raised_[static_cast<std::size_t>(i)]) out.push_back(i);
    return out;
  }

  /// Raises the weight whose growth makes the sum smallest; false where none does.
  bool raise_one() {
    const VecX sum = columns_ * y_;
    const double rounding = 1e-14 * y_.lpNorm<1>();
    if (sum.norm() <= rounding) return false;
    Eigen::Index best = -1;
    double least = -rounding;
    for (Eigen::Index i = 0; i < y_.size(); ++i)
      if (const double rate = columns_.col(i).dot(sum); !raised_[static_cast<std::size_t>(i)] && rate < least) {
        least = rate;
        best = i;
      }
    if (best < 0) return false;
    raised_[static_cast<std::size_t>(best)] = true;
    return true;
  }

  /// Moves the raised weights to where the sum is least, or as far towards that as all of them stay above 1.
  void settle() {
    for (Set set = raised(); !set.empty(); set = raised()) {
      const VecX step = minimum_norm_solution(columns_(Eigen::all, set), -columns_ * y_);
      double length = 1;
      Eigen::Index ends = -1;
      for (Eigen::Index k = 0; k < step.size(); ++k) {
        const double above = y_[set[static_cast<std::size_t>(k)]] - 1;
        if (above + length * step[k] > 0) continue;
        length = step[k] < 0 ? above / -step[k] : 0;
        ends = k;
      }
      for (Eigen::Index k = 0; k < step.size(); ++k) y_[set[static_cast<std::size_t>(k)]] += length * step[k];
      if (ends < 0) return;
      y_[set[static_cast<std::size_t>(ends)]] = 1;
      raised_[static_cast<std::size_t>(set[static_cast<std::size_t>(ends)])] = false;
    }
  }

  MatX columns_;
  VecX y_;
  std::vector<bool> raised_;
};

}  // namespace

bool within(const MatX& bounds, const VecX& motion) {
  return bounds.rows() == 0 || (bounds * motion).maxCoeff() <= kPressed * motion.norm();
}

VecX way_out(const MatX& bounds, const MatX& motions) {
  const VecX none = VecX::Zero(motions.rows());
  const MatX rows = unit_rows(bounds * motions);
  if (rows.rows() == 0) return none;
  const VecX sum = LeastSum(rows).solve();
  if (sum.norm() == 0) return none;
  const VecX way = -sum.normalized(), out = motions * way;
  return (rows * way).minCoeff() < -kLeft && within(bounds, out) ? out : none;
}

}  // namespace genu
