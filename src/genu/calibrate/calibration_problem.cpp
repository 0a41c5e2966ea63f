#include "genu/calibrate/calibration_problem.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "genu/calibrate/tolerances.h"

namespace genu {

CalibrationProblem::CalibrationProblem(const std::vector<CalibrationUnknown>& unknowns,
                                       const std::vector<std::unique_ptr<CalibrationExperiment>>& experiments,
                                       double difference)
    : unknowns_(unknowns), experiments_(experiments), difference_(difference) {}

Eigen::Index CalibrationProblem::target_rows() const {
  std::size_t count = 0;
  for (const auto& e : experiments_)
    if (!e->held_out) count += e->values().size();
  return static_cast<Eigen::Index>(count);
}

CalibrationProblem::At CalibrationProblem::at(const VecX& u, bool derivatives) const {
  At out;
  out.u = u;
  out.predictions.resize(experiments_.size());
  tbb::parallel_for(std::size_t{0}, experiments_.size(), [&](std::size_t e) {
    if (experiments_[e]->held_out) return;
    out.predictions[e] = experiments_[e]->predict(u, derivatives);
    ++runs_;
  });
  Eigen::Index priors = 0;
  for (const CalibrationUnknown& unknown : unknowns_) priors += unknown.prior ? 1 : 0;
  const Eigen::Index rows = target_rows() + priors;
  VecX residuals(rows);
  MatX J = MatX::Zero(rows, u.size());
  bool exact = derivatives;
  Eigen::Index first = 0;
  for (std::size_t e = 0; e < experiments_.size(); ++e) {
    if (experiments_[e]->held_out) continue;
    const CalibrationPrediction& p = out.predictions[e];
    const bool whole = p.values.size() > 0;
    if (!whole && out.failed.empty()) out.failed = p.failed;
    const VecX& values = whole ? p.values : p.part.values;
    const MatX& derivatives_of_values = whole ? p.derivatives : p.part.derivatives;
    if (values.size() == 0) return out;
    const VecX scales = experiments_[e]->scales();
    residuals.segment(first, scales.size()) = (values - experiments_[e]->wanted()).cwiseQuotient(scales);
    exact = exact && derivatives_of_values.size() > 0;
    if (exact) J.middleRows(first, scales.size()) = scales.cwiseInverse().asDiagonal() * derivatives_of_values;
    for (Eigen::Index k = 0; k < scales.size(); ++k)
      out.there.push_back(whole || p.part.there[static_cast<std::size_t>(k)]);
    first += scales.size();
  }
  for (std::size_t k = 0; k < unknowns_.size(); ++k) {
    const CalibrationUnknown& unknown = unknowns_[k];
    if (!unknown.prior) continue;
    const auto column = static_cast<Eigen::Index>(k);
    residuals[first] = (unknown.shown(u[column]) - unknown.prior->mean) / unknown.prior->deviation;
    J(first++, column) = unknown.shown_slope(u[column]) / unknown.prior->deviation;
  }
  out.there.resize(static_cast<std::size_t>(rows), true);
  const bool whole = std::find(out.there.begin(), out.there.end(), false) == out.there.end();
  for (Eigen::Index k = 0; k < rows; ++k)
    if (!out.there[static_cast<std::size_t>(k)]) residuals[k] = 0, J.row(k).setZero();
  (whole ? out.residuals : out.some) = residuals;
  if (exact) (whole ? out.derivatives : out.some_derivatives) = J;
  return out;
}

std::optional<MatX> CalibrationProblem::jacobian(const At& here) const {
  if (here.derivatives.size() > 0) return here.derivatives;
  const auto n = static_cast<std::size_t>(here.u.size());
  std::vector<VecX> beside(2 * n);
  tbb::parallel_for(std::size_t{0}, 2 * n, [&](std::size_t k) {
    VecX u = here.u;
    u[static_cast<Eigen::Index>(k / 2)] += k % 2 == 0 ? difference_ : -difference_;
    beside[k] = at(u, false).residuals;
  });
  MatX J(here.residuals.size(), here.u.size());
  for (std::size_t k = 0; k < n; ++k) {
    if (beside[2 * k].size() == 0 || beside[2 * k + 1].size() == 0) return std::nullopt;
    J.col(static_cast<Eigen::Index>(k)) = (beside[2 * k] - beside[2 * k + 1]) / (2 * difference_);
  }
  return J;
}

bool CalibrationProblem::has_stated_errors() const {
  for (const auto& e : experiments_)
    if (!e->held_out && !e->columns().empty()) return e->columns().front().stated;
  return false;
}

std::optional<double> CalibrationProblem::misfit(const VecX& residuals, Eigen::Index fitted) const {
  const auto spare = static_cast<double>(residuals.size() - fitted);
  if (!has_stated_errors() || !(spare > 0)) return std::nullopt;
  const double share = residuals.squaredNorm() / spare;
  return share > 1 + kMisfit * std::sqrt(2 / spare) ? std::optional(share) : std::nullopt;
}

double derivative_noise(bool exact) { return exact ? kExactDerivativeNoise : kDerivativeNoise; }

}  // namespace genu
