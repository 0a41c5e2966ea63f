#include "genu/equilibrium/stability.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "genu/core/decompositions.h"
#include "genu/equilibrium/moving_blocks.h"
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

}  // namespace genu
