#include "genu/equilibrium/newton_step.h"

#include <algorithm>
#include <cmath>

#include "genu/equilibrium/moving_blocks.h"

namespace genu {

void NewtonStep::set_scales(const Linearization& at, const Target& target) {
  const double L = model_->scales.length, F = model_->scales.force;
  const bool dense = route_ == Route::dense;
  const int size = twists_ + constraints_ + (dense ? 5 : 1) * contacts_ + (bordered_ ? 1 : 0);
  row_scale_.resize(size);
  column_scale_.resize(size);
  if (bordered_) row_scale_[size - 1] = column_scale_[size - 1] = 1;
  for (int i = 0; i < twists_; ++i) {
    const bool translation = i % 6 < 3;
    row_scale_[i] = translation ? 1 / F : 1 / (F * L);
    column_scale_[i] = translation ? L : 1;
  }
  for (int m = 0; m < constraints_; ++m) {
    const bool rotation = is_rotation(*model_, target, static_cast<std::size_t>(m));
    row_scale_[twists_ + m] = rotation ? 1 : 1 / L;
    column_scale_[twists_ + m] = rotation ? F * L : F;
  }
  for (const auto& column : at.load_columns) {
    const double largest = column.wrench.cwiseProduct(row_scale_.head(twists_)).lpNorm<Eigen::Infinity>();
    column_scale_[twists_ + column.row] = largest > 0 ? 1 / largest : 1;
  }
  for (int c = 0; c < contacts_; ++c) {
    const int first = twists_ + constraints_ + (dense ? 5 : 1) * c;
    if (dense) {
      row_scale_.segment<5>(first) << 1 / L, 1 / L, 1 / L, 1, 1;
      column_scale_.segment<5>(first) << L, L, L, L, F;
    } else {
      row_scale_[first] = 1 / L;
      column_scale_[first] = F;
    }
  }
}

void NewtonStep::assemble_dense(const Linearization& at) {
  matrix_.topLeftCorner(twists_, twists_) = at.stiffness;
  for (int c = 0; c < contacts_; ++c) {
    const ContactBlock& block = at.contacts[static_cast<std::size_t>(c)];
    const int first = twists_ + constraints_ + 5 * c;
    matrix_.block<5, 4>(first, first) = block.d_surface;
    for_moving(bodies_[static_cast<std::size_t>(c)], [&](int from, int to) {
      matrix_.block<5, 6>(first, to) = block.d_twist.middleCols<6>(from);
      matrix_.block<6, 4>(to, first) = block.wrench_d_surface.middleRows<6>(from);
      matrix_.block<6, 1>(to, first + 4) = block.direction.segment<6>(from);
    });
  }
}

bool NewtonStep::eliminate(const Linearization& at) {
  eliminated_.resize(at.contacts.size());
  bool regular = true;
  for (std::size_t c = 0; c < at.contacts.size(); ++c)
    regular = eliminated_[c].factor(at.contacts[c], model_->scales.length, which_move(at.contact_bodies[c])) && regular;
  return regular;
}

void NewtonStep::assemble_eliminated(const Linearization& at) {
  matrix_.topLeftCorner(twists_, twists_) = at.stiffness;
  for (int c = 0; c < contacts_; ++c) {
    const auto k = static_cast<std::size_t>(c);
    const EliminatedContact& contact = eliminated_[k];
    // `stiffness` of the linearization contains the contact's part with fixed surface points. Replace it by the total.
    const Mat12 &whole = contact.stiffness, &held = at.contacts[k].wrench_d_twist;
    const int row = twists_ + constraints_ + c;
    for_moving(bodies_[k], [&](int from, int to) {
      for_moving(bodies_[k], [&](int from2, int to2) {
        matrix_.block<6, 6>(to, to2) += whole.block<6, 6>(from, from2) - held.block<6, 6>(from, from2);
      });
      matrix_.block<6, 1>(to, row) = at.contacts[k].direction.segment<6>(from);
      matrix_.block<1, 6>(row, to) = contact.gap_gradient.segment<6>(from).transpose();
    });
  }
}

void NewtonStep::add_border(const Border& border) {
  const Eigen::Index last = matrix_.rows() - 1;
  matrix_.col(last).head(twists_) = border.wrench_rate;
  matrix_.col(last).segment(twists_, constraints_) = border.constraint_rate;
  matrix_.row(last).head(twists_) = border.twist.transpose();
  matrix_(last, last) = border.parameter;
}

bool NewtonStep::factor(const Linearization& at, const Target& target, Route route, const Border* border) {
  twists_ = static_cast<int>(at.wrench.size());
  constraints_ = static_cast<int>(at.constraint.size());
  contacts_ = static_cast<int>(at.contacts.size());
  bodies_ = at.contact_bodies;
  bordered_ = border != nullptr;
  route_ = Route::dense;
  if (route != Route::dense) {
    if (eliminate(at))
      route_ = Route::eliminated;
    else if (route == Route::eliminated)
      return false;
  }
  set_scales(at, target);
  matrix_.setZero(row_scale_.size(), row_scale_.size());
  matrix_.block(0, twists_, twists_, constraints_) = at.gradient.transpose();
  matrix_.block(twists_, 0, constraints_, twists_) = at.gradient;
  for (const auto& column : at.load_columns) matrix_.col(twists_ + column.row).head(twists_) = column.wrench;
  route_ == Route::dense ? assemble_dense(at) : assemble_eliminated(at);
  if (bordered_) add_border(*border);
  for (Eigen::Index j = 0; j < matrix_.cols(); ++j)
    matrix_.col(j) = matrix_.col(j).cwiseProduct(row_scale_) * column_scale_[j];
  return solver_.factor(matrix_, route_ == Route::dense ? 0 : twists_ / 6);
}

void NewtonStep::solve(const Linearization& at, Correction& out) {
  rhs_.resize(row_scale_.size());
  if (bordered_) rhs_[rhs_.size() - 1] = 0;
  rhs_.head(twists_) = -at.wrench;
  rhs_.segment(twists_, constraints_) = -at.constraint;
  for (int c = 0; c < contacts_; ++c) {
    const auto k = static_cast<std::size_t>(c);
    if (route_ == Route::dense) {
      rhs_.segment<5>(twists_ + constraints_ + 5 * c) = -at.contacts[k].residual;
      continue;
    }
    EliminatedContact& contact = eliminated_[k];
    contact.set_residual(at.contacts[k].residual);
    rhs_[twists_ + constraints_ + c] = -contact.gap;
    for_moving(bodies_[k], [&](int from, int to) { rhs_.segment<6>(to) -= contact.wrench_offset.segment<6>(from); });
  }
  solve_and_unpack(out);
}

void NewtonStep::solve_rates(const VecX& wrench_rate, const VecX& constraint_rate, Correction& out) {
  rhs_.setZero(row_scale_.size());
  rhs_.head(twists_) = -wrench_rate;
  rhs_.segment(twists_, constraints_) = -constraint_rate;
  for (EliminatedContact& contact : eliminated_) contact.set_residual(Vec5::Zero());
  solve_and_unpack(out);
}

void NewtonStep::solve_direction(Correction& out) {
  rhs_.setZero(row_scale_.size());
  rhs_[rhs_.size() - 1] = 1;
  for (EliminatedContact& contact : eliminated_) contact.set_residual(Vec5::Zero());
  solve_and_unpack(out);
}

void NewtonStep::solve_and_unpack(Correction& out) {
  rhs_.array() *= row_scale_.array();
  solver_.solve(rhs_, x_);
  x_.array() *= column_scale_.array();
  out.resize(twists_ / 6, constraints_, contacts_);
  out.twist = x_.head(twists_);
  out.multipliers = x_.segment(twists_, constraints_);
  out.parameter = bordered_ ? x_[x_.size() - 1] : 0;
  for (int c = 0; c < contacts_; ++c) {
    const auto k = static_cast<std::size_t>(c);
    if (route_ == Route::dense) {
      const int first = twists_ + constraints_ + 5 * c;
      out.surface[k] = x_.segment<4>(first);
      out.forces[c] = x_[first + 4];
      continue;
    }
    const EliminatedContact& contact = eliminated_[k];
    out.forces[c] = x_[twists_ + constraints_ + c];
    out.surface[k] = contact.surface_offset;
    for_moving(bodies_[k], [&](int from, int to) {
      out.surface[k] += contact.surface_gain.middleCols<6>(from) * x_.segment<6>(to);
    });
  }
}

double NewtonStep::residual(const Linearization& at, const Target& target) const {
  const double L = model_->scales.length, F = model_->scales.force;
  double worst = 0;
  // std::max() drops a NaN in its second argument; the first argument keeps it, so that the caller sees it.
  auto add = [&worst](double value) { worst = std::isnan(value) ? value : std::max(worst, std::abs(value)); };
  for (Eigen::Index i = 0; i < at.wrench.size(); ++i) add(at.wrench[i] / (i % 6 < 3 ? F : F * L));
  for (Eigen::Index m = 0; m < at.constraint.size(); ++m)
    add(at.constraint[m] / (is_rotation(*model_, target, static_cast<std::size_t>(m)) ? 1 : L));
  for (const ContactBlock& block : at.contacts)
    for (int i = 0; i < 5; ++i) add(block.residual[i] / (i < 3 ? L : 1));
  return worst;
}

double NewtonStep::norm(const Correction& correction) const {
  const double L = model_->scales.length, F = model_->scales.force;
  double square = 0;
  for (Eigen::Index i = 0; i < correction.twist.size(); ++i)
    square += std::pow(correction.twist[i] / (i % 6 < 3 ? L : 1), 2);
  for (Eigen::Index m = 0; m < correction.multipliers.size(); ++m)
    square += std::pow(correction.multipliers[m] / column_scale_[twists_ + m], 2);
  for (const Vec4& ds : correction.surface) square += ds.squaredNorm() / (L * L);
  square += correction.forces.squaredNorm() / (F * F);
  square += correction.parameter * correction.parameter;
  return std::sqrt(square);
}

}  // namespace genu
