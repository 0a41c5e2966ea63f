#include "genu/solver/way_out.h"

#include <algorithm>

namespace genu {
namespace {

constexpr double kPressed = 1e-9;  // what a motion of unit norm exceeds a bound by less is rounding

}  // namespace

bool within(const MatX& bounds, const VecX& motion) {
  return bounds.rows() == 0 || (bounds * motion).maxCoeff() <= kPressed * motion.norm();
}

VecX way_out(const MatX& bounds, const MatX& motions) {
  const MatX rates = bounds * motions;
  VecX y = VecX::Ones(rates.rows()), left = rates.transpose() * y;
  constexpr int kSweeps = 1000;
  constexpr double kNone = 1e-6;  // of what is left: no way out
  for (int sweep = 0; sweep < kSweeps && left.norm() > kNone * y.norm(); ++sweep) {
    const VecX before = y;
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      const double norm = rates.row(i).squaredNorm();
      if (norm < kPressed * kPressed) continue;
      const double next_y = std::max(1.0, y[i] - rates.row(i).dot(left) / norm);
      left += (next_y - y[i]) * rates.row(i).transpose();
      y[i] = next_y;
    }
    if ((y - before).norm() <= 1e-14 * y.norm()) break;
  }
  const VecX none = VecX::Zero(motions.rows());
  const VecX out = left.norm() > kNone * y.norm() ? VecX(-motions * left.normalized()) : none;
  return within(bounds, out) ? out : none;
}

}  // namespace genu
