#include "genu/equilibrium/stability_by_blocks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "genu/core/decompositions.h"
#include "genu/equilibrium/block_lu.h"
#include "genu/equilibrium/tolerances.h"

namespace genu {
namespace {

/// Matrices of hundreds of rows, for pose after pose.
struct Memory {
  FreeStiffness of;
  MatX matrix, basis;
  BlockLu factors;
};

/// [K A^T; A 0] of the rows that hold something, A in the size of K, K made symmetric. Loads that drive a coordinate
/// hold nothing. `skew`: twice the norm of the part of K that is not symmetric.
void set_bordered(const Linearization& at, const FreeStiffness& of, MatX& out, double& skew) {
  const Eigen::Index n = of.stiffness.rows();
  MatX held = of.held;
  for (const auto& column : at.load_columns) held.row(column.row).setZero();
  Eigen::Index rows = 0;
  for (Eigen::Index i = 0; i < held.rows(); ++i)
    if (held.row(i).norm() > 0) held.row(rows++) = held.row(i);
  out.setZero(n + rows, n + rows);
  double squares = 0, size = 0;
  for (Eigen::Index i = 0; i < n; i += 6)
    for (Eigen::Index j = 0; j <= i; j += 6) {
      const Mat6 K = of.stiffness.block<6, 6>(i, j), turned = of.stiffness.block<6, 6>(j, i).transpose();
      const Mat6 mean = (K + turned) / 2;
      squares += (i == j ? 1 : 2) * (K - turned).squaredNorm();
      size = std::max(size, mean.lpNorm<Eigen::Infinity>());
      out.block<6, 6>(i, j) = mean;
      out.block<6, 6>(j, i) = mean.transpose();
    }
  skew = std::sqrt(squares);
  out.bottomLeftCorner(rows, n) = size * held.topRows(rows);
  out.topRightCorner(n, rows) = out.bottomLeftCorner(rows, n).transpose();
}

/// The transpose of about_own_origins().
VecX transposed_about_own_origins(const Linearization& at, VecX motion) {
  for (Eigen::Index k = 0; k < at.own_origins.size() / 3; ++k) {
    const Mat3 turn = -skew(at.own_origins.segment<3>(3 * k) / kMetricLength);
    motion.segment<3>(6 * k + 3) += turn.transpose() * motion.segment<3>(6 * k);
  }
  return motion;
}

/// The free motions' flexibility: the inverse of Z^T K Z, on all motions.
class Flexibility {
 public:
  Flexibility(const Linearization& at, BlockLu& factors, Eigen::Index constraints, bool own_origins)
      : at_(at), factors_(factors), own_(own_origins), right_(VecX::Zero(at.wrench.size() + constraints)) {}

  Eigen::Index size() const { return at_.wrench.size(); }
  VecX operator()(const VecX& b) {
    right_.head(size()) = own_ ? transposed_about_own_origins(at_, b) : b;
    factors_.solve(right_, solved_);
    return own_ ? VecX(about_own_origins(at_, solved_.head(size()))) : VecX(solved_.head(size()));
  }

 private:
  const Linearization& at_;
  BlockLu& factors_;
  bool own_;
  VecX right_, solved_;
};

struct Softest {
  double flexibility = 0;
  VecX motion;
};

/// The largest eigenvalue of a positive semidefinite operator, with full reorthogonalization.
std::optional<Softest> softest(Flexibility flexibility, MatX& basis) {
  VecX v(flexibility.size());
  // No motion of a body, and no sum of motions, is left out.
  for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = std::sin(1.0 + 1.7 * static_cast<double>(i));
  v = flexibility(v);
  if (!(v.norm() > 0) || !v.allFinite()) return std::nullopt;
  basis.resize(v.size(), kMostLanczosSteps);
  MatX T = MatX::Zero(kMostLanczosSteps, kMostLanczosSteps);
  basis.col(0) = v.normalized();
  for (int k = 0; k < kMostLanczosSteps; ++k) {
    VecX w = flexibility(basis.col(k));
    T(k, k) = basis.col(k).dot(w);
    const auto known = basis.leftCols(k + 1);
    w -= known * (known.transpose() * w);
    w -= known * (known.transpose() * w);  // once is not orthogonal to rounding
    const double next = w.norm();
    const bool look = k % 4 == 3 || !(next > 0);
    if (look) {
      const auto eigen = symmetric_eigen(MatX(T.topLeftCorner(k + 1, k + 1)));
      const double largest = eigen.values[k];
      if (!(largest > 0)) return std::nullopt;
      if (next * std::abs(eigen.vectors(k, k)) <= kLanczosResidual * largest)
        return Softest{largest, known * eigen.vectors.col(k)};
    }
    if (k + 1 == kMostLanczosSteps || !(next > 0)) break;
    T(k, k + 1) = T(k + 1, k) = next;
    basis.col(k + 1) = w / next;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Stability> stable_by_blocks(const Linearization& at, double length_scale) {
  thread_local Memory memory;
  auto& [of, matrix, basis, factors] = memory;
  tangent_stiffness(at, length_scale, 0, of);
  const Eigen::Index n = at.wrench.size();
  double skew = 0;
  set_bordered(at, of, matrix, skew);
  if (!(skew <= 2 * of.known_to)) return std::nullopt;
  const Eigen::Index constraints = matrix.rows() - n;
  if (!factors.factor(matrix, static_cast<int>(n / 6)) || !(factors.rcond() > kTrustLu)) return std::nullopt;
  if (factors.negative_eigenvalues() != constraints) return std::nullopt;
  const auto found = softest({at, factors, constraints, false}, basis);
  if (!found || !(1 / found->flexibility > std::max(kNeutralShare * of.stiffness.norm(), of.known_to)))
    return std::nullopt;
  Stability out;
  out.free_motions = static_cast<int>(n - constraints);
  out.smallest = 1 / found->flexibility;
  out.mode = found->motion.normalized();
  out.neutral.resize(n, 0);
  if (of.held.rows() > constraints) out.redundant = taking_part(self_stresses(at, length_scale));
  if (at.own_origins.size() == 0) return out;
  const auto own = softest({at, factors, constraints, true}, basis);
  if (!own) return std::nullopt;
  out.smallest = 1 / own->flexibility;
  return out;
}

}  // namespace genu
