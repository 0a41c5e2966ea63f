#include "genu/equilibrium/stability.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "genu/core/decompositions.h"
#include "genu/equilibrium/moving_blocks.h"
#include "genu/equilibrium/stability_by_blocks.h"
#include "genu/equilibrium/tolerances.h"

namespace genu {
namespace {

/// How large the terms are that a contact adds to the tangent stiffness, J: of a ball on a plane they cancel.
double size_of_terms(const ContactBlock& block, const EliminatedContact& contact, WhichMove moves) {
  const Vec6 unit = stability_metric(6);
  double squares = 0;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      if (!moves[i] || !moves[j]) continue;
      const auto whole = contact.stiffness.block<6, 6>(6 * i, 6 * j),
                 held = block.wrench_d_twist.block<6, 6>(6 * i, 6 * j);
      squares += (unit.asDiagonal() * (whole.cwiseAbs() + held.cwiseAbs()) * unit.asDiagonal()).squaredNorm();
    }
  return std::sqrt(squares);
}

/// Tangent stiffness and gradients of constraints, of gaps, and of what conforming surfaces hold besides, in the
/// metric; where loads drive a coordinate their wrench in the place of its gradient. Returns the accuracy of the
/// stiffness, J: rounding of its terms, and forces out of balance, which make it unsymmetric by the same amount.
double tangent(const Linearization& at, double length_scale, double cancelled, MatX& stiffness, MatX& held) {
  const Eigen::Index n = at.wrench.size(), m = at.constraint.size();
  const auto contacts = static_cast<Eigen::Index>(at.contacts.size());
  stiffness = at.stiffness;
  held.setZero(m + contacts, n);
  held.topRows(m) = at.gradient;
  for (const auto& column : at.load_columns) held.row(column.row) = column.wrench.transpose();
  Eigen::Index rows = m + contacts;
  double terms = cancelled;
  for (Eigen::Index c = 0; c < contacts; ++c) {
    const auto k = static_cast<std::size_t>(c);
    EliminatedContact contact;
    const WhichMove moves = which_move(at.contact_bodies[k]);
    if (!contact.factor(at.contacts[k], length_scale, moves))
      contact.factor_minimum_norm(at.contacts[k], length_scale, moves);
    terms += size_of_terms(at.contacts[k], contact, moves);
    const Mat12 added = contact.stiffness - at.contacts[k].wrench_d_twist;
    for_moving(at.contact_bodies[k], [&](int from, int to) {
      held.block<1, 6>(m + c, to) = contact.gap_gradient.segment<6>(from).transpose();
      for_moving(at.contact_bodies[k],
                 [&](int from2, int to2) { stiffness.block<6, 6>(to, to2) += added.block<6, 6>(from, from2); });
    });
    const Eigen::Index more = contact.closure.rows();
    if (more == 0) continue;
    held.conservativeResize(rows + more, n);
    held.bottomRows(more).setZero();
    for_moving(at.contact_bodies[k],
               [&](int from, int to) { held.block(rows, to, more, 6) = contact.closure.middleCols<6>(from); });
    rows += more;
  }
  const VecX unit = stability_metric(n);
  for (Eigen::Index j = 0; j < n; ++j) stiffness.col(j) = -(stiffness.col(j).cwiseProduct(unit) * unit[j]);
  held = held * unit.asDiagonal();
  for (Eigen::Index i = 0; i < held.rows(); ++i) {
    const double norm = held.row(i).norm();
    if (norm > 0) held.row(i) /= norm;
  }
  return std::max(kCancelledStiffness * (terms + stiffness.norm()), at.wrench.cwiseProduct(unit).norm());
}

/// Rows: the first `count` rows of `held`. The others take part and are not returned.
MatX self_stresses_of(const MatX& held, Eigen::Index count, double dependent) {
  MatX out = kernel(held.transpose(), dependent);
  out.colwise().normalize();
  return out.topRows(count);
}

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

MatX about_own_origins(const Linearization& at, MatX motions) {
  for (Eigen::Index k = 0; k < at.own_origins.size() / 3; ++k) {
    const Mat3 turn = -skew(at.own_origins.segment<3>(3 * k) / kMetricLength);
    motions.middleRows<3>(6 * k) += turn * motions.middleRows<3>(6 * k + 3);
  }
  return motions;
}

VecX stability_metric(Eigen::Index n) {
  VecX out(n);
  for (Eigen::Index i = 0; i < n; ++i) out[i] = i % 6 < 3 ? kMetricLength : 1.0;
  return out;
}

MatX self_stresses(const Linearization& at, double length_scale, double dependent) {
  MatX stiffness, held;
  tangent(at, length_scale, 0, stiffness, held);
  return self_stresses_of(held, at.constraint.size() + static_cast<Eigen::Index>(at.contacts.size()), dependent);
}

std::vector<int> taking_part(const MatX& self_stresses) {
  std::vector<int> out;
  for (Eigen::Index i = 0; i < self_stresses.rows(); ++i)
    if (self_stresses.cols() > 0 && self_stresses.row(i).cwiseAbs().maxCoeff() > kPartOfSelfStress)
      out.push_back(static_cast<int>(i));
  return out;
}

const char* to_string(Stability::Verdict verdict) {
  switch (verdict) {
    case Stability::Verdict::stable:
      return "stable";
    case Stability::Verdict::unstable:
      return "unstable";
    case Stability::Verdict::neutral:
      return "neutral";
  }
  return "";
}

const char* to_string(const Stability& stability) {
  const bool falls = stability.verdict == Stability::Verdict::unstable && !stability.flutter;
  return stability.complex_pair && !falls ? "flutter" : to_string(stability.verdict);
}

void tangent_stiffness(const Linearization& at, double length_scale, double cancelled, FreeStiffness& out) {
  out.known_to = tangent(at, length_scale, cancelled, out.stiffness, out.held);
}

FreeStiffness free_stiffness(const Linearization& at, double length_scale, double cancelled) {
  FreeStiffness out;
  tangent_stiffness(at, length_scale, cancelled, out);
  MatX fixed = out.held;
  for (const auto& column : at.load_columns) fixed.row(column.row).setZero();  // a dead load holds nothing
  out.basis = null_space(fixed, kDependentRow);
  return out;
}

Stability assess_stability(const Linearization& at, double length_scale) {
  if (at.wrench.size() >= Eigen::Index{6} * kManyBodies)
    if (auto stable = stable_by_blocks(at, length_scale)) return std::move(*stable);
  Stability out;
  const auto [stiffness, held, basis, known_to] = free_stiffness(at, length_scale);
  out.free_motions = static_cast<int>(basis.cols());
  if (held.rows() + basis.cols() > at.wrench.size())
    out.redundant = taking_part(
        self_stresses_of(held, at.constraint.size() + static_cast<Eigen::Index>(at.contacts.size()), kDependentRow));
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
