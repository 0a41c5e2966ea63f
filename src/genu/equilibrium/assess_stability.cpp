// assess_stability(): by blocks where that is cheaper, else from all eigenvalues.
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

#include "genu/core/decompositions.h"
#include "genu/equilibrium/stability.h"
#include "genu/equilibrium/stability_by_blocks.h"
#include "genu/equilibrium/tolerances.h"

namespace genu {
namespace {

/// The smallest eigenvalue with motions measured about the bodies' own origins, which may be far away: K y = lambda M y
/// on the free motions. M spans so many decades that rounding would hide the small eigenvalues of M^-1 K, but not the
/// large ones of K^-1 M. The small ones of K^-1 M are rounding and are omitted. The choice of origins does not change
/// the signs. Where no remaining eigenvalue has the sign of `nearby` (the smallest about the origins of the poses),
/// `nearby` is returned.
double smallest_about_own_origins(const Linearization& at, const MatX& basis, const MatX& stiffness, double nearby) {
  const MatX k = basis.transpose() * stiffness * basis, motions = about_own_origins(at, basis);
  const MatX product = full_pivot_solution(k, motions.transpose() * motions);
  if (product.size() == 0) return 0;
  const Eigen::VectorXcd inverse = general_eigenvalues(product);
  const double largest = inverse.cwiseAbs().maxCoeff();
  double smallest = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < inverse.size(); ++i)
    if (std::abs(inverse[i]) > kNeutralShare * largest) smallest = std::min(smallest, (1.0 / inverse[i]).real());
  return (smallest < 0) == (nearby < 0) ? smallest : nearby;
}

/// The motions at no cost, one column each, also where others have a negative cost.
MatX motions_below(double nothing, const GeneralEigen& eigen, const MatX& basis) {
  MatX out(basis.rows(), 0);
  for (Eigen::Index i = 0; i < eigen.values.size(); ++i) {
    if (std::abs(eigen.values[i]) > nothing) continue;
    out.conservativeResize(Eigen::NoChange, out.cols() + 1);
    // Rounding may turn two real eigenvectors into a complex pair: its real and imaginary parts are the two.
    const Eigen::VectorXcd vector = eigen.vectors.col(i);
    const bool second = eigen.values[i].imag() < 0;
    out.rightCols<1>() = (basis * (second ? VecX(vector.imag()) : VecX(vector.real()))).normalized();
  }
  return out.cols() == basis.cols() ? basis : out;  // all motions: the basis itself is more accurate than eigenvectors
}

}  // namespace

Stability assess_stability(const Linearization& at, double length_scale) {
  if (at.wrench.size() >= Eigen::Index{6} * kManyBodies)
    if (auto stable = stable_by_blocks(at, length_scale)) return std::move(*stable);
  Stability out;
  const auto [stiffness, held, basis, known_to] = free_stiffness(at, length_scale);
  out.free_motions = static_cast<int>(basis.cols());
  if (held.rows() + basis.cols() > at.wrench.size()) out.redundant = taking_part(self_stresses(at, length_scale));
  if (basis.cols() == 0) {
    out.smallest = std::numeric_limits<double>::infinity();
    out.mode = VecX::Zero(at.wrench.size());
    return out;
  }
  const GeneralEigen eigen = general_eigen(basis.transpose() * stiffness * basis);
  Eigen::Index first = 0;
  eigen.values.real().minCoeff(&first);
  const std::complex<double> value = eigen.values[first];
  const double largest = eigen.values.cwiseAbs().maxCoeff();
  const double real = std::max(kRealShare * largest, known_to);
  out.complex_pair = eigen.values.imag().cwiseAbs().maxCoeff() > real;
  out.smallest =
      at.own_origins.size() == 0 ? value.real() : smallest_about_own_origins(at, basis, stiffness, value.real());
  out.flutter = std::abs(value.imag()) > real;
  out.mode = basis * eigen.vectors.col(first).real();
  if (out.mode.norm() > 0) out.mode.normalize();
  const double nothing = std::max(kNeutralShare * largest, known_to);
  if (std::abs(value.real()) <= nothing)
    out.verdict = Stability::Verdict::neutral;
  else
    out.verdict = value.real() > 0 ? Stability::Verdict::stable : Stability::Verdict::unstable;
  out.neutral = motions_below(nothing, eigen, basis);
  return out;
}

}  // namespace genu
