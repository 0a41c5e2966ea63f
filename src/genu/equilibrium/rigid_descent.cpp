#include "genu/equilibrium/rigid_descent.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "genu/core/decompositions.h"
#include "genu/equilibrium/contact_inspection.h"
#include "genu/equilibrium/feasible_direction.h"
#include "genu/equilibrium/moving_blocks.h"
#include "genu/equilibrium/stability.h"
#include "genu/equilibrium/tolerances.h"
#include "genu/model/correction.h"
#include "genu/model/ligament_pieces.h"

namespace genu {
namespace {

class RigidDescent {
 public:
  RigidDescent(const JointModel& model, ContactField& field, const Target& target, const Cancelled& cancelled)
      : model_(model), field_(field), target_(target), cancelled_(cancelled) {
    stop_layers_when(cancelled, here_);
  }

  RestReport run(State& state) {
    RestReport report;
    for (double& multiplier : state.multipliers) multiplier = 0;
    for (; report.steps < kMaxSlides && !asked_to_stop(cancelled_); ++report.steps) {
      look(state);
      if (!here_.wrench.allFinite()) break;
      report.over_edge = over_edge();
      if (report.over_edge) break;
      bool stepped = false;
      for (int tries = 0; tries < kMaxSlideTries && !stepped; ++tries) {
        if (!find_step()) return report;
        stepped = excess() <= 1;
        if (!stepped) damping_ = std::max(kSlideDampingRatio * damping_, least_stiffness());
      }
      if (!stepped) break;
      const bool small = excess() <= kNewtonStep && damping_ <= least_stiffness();
      if (!retract(model_, state, correction_, 1, trial_)) break;
      std::swap(state, trial_);
      for (Eigen::Index k = 0; k < multipliers_.size(); ++k) state.multipliers[at(k)] = multipliers_[k];
      keep_forces();
      if (small) {
        report.at_rest = true;
        for (std::size_t c = 0; c < seen_.size(); ++c)
          if (forces_[static_cast<Eigen::Index>(c)] > 0) {
            report.pressing.push_back(seen_[c]);
            report.forces.push_back(forces_[static_cast<Eigen::Index>(c)]);
          }
        break;
      }
      if (excess() < kShortSlide) damping_ /= kSlideDampingRatio;
      if (damping_ < kNoSlideDamping * least_stiffness()) damping_ = 0;
    }
    return report;
  }

 private:
  /// Contact would have to continue past an edge. A little overlap there may be of the last step.
  bool over_edge() const {
    return std::any_of(survey_.edges.begin(), survey_.edges.end(),
                       [&](const Candidate& c) { return c.minimum.gap < -field_.window(); });
  }

  double least_stiffness() const { return kMinDescentStiffness * model_.scales.force * model_.scales.length; }

  /// The places in reach, with the forces of the last step, and the equations there.
  void look(const State& state) {
    field_.survey(state, survey_);
    seen_ = survey_.minima;
    probe_ = state;
    probe_.contacts.clear();
    for (const Candidate& c : seen_) probe_.contacts.push_back({c.pair, 0, c.minimum.contact, last_force(c)});
    linearize(model_, probe_, target_, here_);
  }

  double last_force(const Candidate& c) const {
    double out = 0, nearest = 2 * field_.spacing();
    for (std::size_t k = 0; k < last_.size(); ++k) {
      if (last_[k].pair != c.pair) continue;
      const double apart = (last_[k].minimum.contact.b.p - c.minimum.contact.b.p).norm();
      if (apart < nearest) nearest = apart, out = last_forces_[k];
    }
    return out;
  }

  void keep_forces() {
    last_ = seen_;
    last_forces_.assign(forces_.data(), forces_.data() + forces_.size());
  }

  /// The step from `here_`, its multipliers and contact forces. False where the surfaces leave no way.
  bool find_step() {
    const Eigen::Index n = here_.wrench.size(), m = here_.constraint.size();
    const auto contacts = static_cast<Eigen::Index>(seen_.size());
    const VecX unit = stability_metric(n);
    MatX gaps = MatX::Zero(contacts, n);
    VecX gap(contacts), force = here_.wrench;
    for (Eigen::Index c = 0; c < contacts; ++c) {
      const auto k = static_cast<std::size_t>(c);
      for_moving(here_.contact_bodies[k], [&](int from, int to) {
        gaps.block<1, 6>(c, to) = here_.contacts[k].direction.segment<6>(from).transpose();
      });
      gap[c] = seen_[k].minimum.gap;
      force -= probe_.contacts[k].force * gaps.row(c).transpose();
    }
    for (Eigen::Index k = 0; k < m; ++k) force -= probe_.multipliers[at(k)] * here_.gradient.row(k).transpose();
    force = unit.asDiagonal() * force;
    gaps = gaps * unit.asDiagonal();
    MatX held = here_.gradient * unit.asDiagonal();
    VecX motion = VecX::Zero(n);
    MatX free = MatX::Identity(n, n);
    if (m > 0) {
      free = null_space(held, kDependentRow);
      motion = minimum_norm_solution(held, -here_.constraint);
    }
    const FreeStiffness stiffness = free_stiffness(here_, model_.scales.length);
    if (!stiffness.stiffness.allFinite()) return false;
    const MatX k = free.transpose() * stiffness.stiffness * free;
    const auto eigen = symmetric_eigen(MatX(0.5 * (k + k.transpose())));
    const VecX root = (eigen.values.cwiseAbs().cwiseMax(least_stiffness()).array() + damping_).sqrt();
    // z = root V^T y - aim, the shortest with rows z >= least.
    const MatX back = free * eigen.vectors * root.cwiseInverse().asDiagonal();  // z to motion
    const VecX aim = back.transpose() * (force - stiffness.stiffness * motion);
    MatX rows = gaps * back;
    VecX least = -(gap + gaps * motion) - rows * aim, length = VecX::Ones(contacts);
    for (Eigen::Index c = 0; c < contacts; ++c)
      if (const double norm = rows.row(c).norm(); norm > 0) length[c] = norm;
    rows.array().colwise() /= length.array();
    least.array() /= length.array();
    VecX z = VecX::Zero(rows.cols());
    forces_ = VecX::Zero(contacts);
    if (contacts > 0 && least.maxCoeff() > 0) {
      const double size = least.maxCoeff();
      MatX columns(rows.cols() + 1, contacts);
      columns.topRows(rows.cols()) = rows.transpose();
      columns.bottomRows<1>() = least.transpose() / size;
      const VecX u = nonnegative_least_squares(columns, VecX::Unit(rows.cols() + 1, rows.cols()));
      const double rest = 1 - columns.row(rows.cols()).dot(u);
      if (!(rest > kNoWay)) return false;
      z = size / rest * (rows.transpose() * u);
      forces_ = (size / rest * u).cwiseQuotient(length);
    }
    motion += back * (z + aim);
    // What the contacts leave of the force along the constraints is theirs.
    if (m > 0) {
      const VecX left = force + gaps.transpose() * forces_ - stiffness.stiffness * motion;
      multipliers_ = minimum_norm_solution(held.transpose(), -left);
    } else {
      multipliers_.resize(0);
    }
    correction_.resize(model_.moving_count, static_cast<int>(m), 0);
    correction_.multipliers.setZero();
    correction_.twist = unit.asDiagonal() * motion;
    return correction_.twist.allFinite();
  }

  /// The step in units of the longest allowed step.
  double excess() const {
    double out = 0;
    for (Eigen::Index i = 0; i < correction_.twist.size(); i += 6) {
      out = std::max(
          out, correction_.twist.segment<3>(i).norm() / (kSlideStride * kMaxDescentTranslation * model_.scales.size));
      out = std::max(out, correction_.twist.segment<3>(i + 3).norm() / (kSlideStride * kMaxDescentRotation));
    }
    return out;
  }

  static std::size_t at(Eigen::Index k) { return static_cast<std::size_t>(k); }

  const JointModel& model_;
  ContactField& field_;
  const Target& target_;
  const Cancelled& cancelled_;
  Survey survey_;
  std::vector<Candidate> seen_, last_;
  std::vector<double> last_forces_;
  State probe_, trial_;
  Linearization here_;
  Correction correction_;
  VecX forces_, multipliers_;
  double damping_ = 0;
};

}  // namespace

RestReport slide_to_rest(const JointModel& model, ContactField& field, const Target& target, State& state,
                         const Cancelled& cancelled) {
  state.contacts.clear();
  reset_pieces(model, state);
  for (LigamentPiece& piece : state.pieces) piece.by_length = true;  // a seed may cross any break
  fit_multipliers(model, target, state);
  const RestReport report = RigidDescent(model, field, target, cancelled).run(state);
  reset_pieces(model, state);
  return report;
}

}  // namespace genu
