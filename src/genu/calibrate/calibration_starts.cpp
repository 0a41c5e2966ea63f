#include "genu/calibrate/calibration_starts.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/calibrate/tolerances.h"

namespace genu {

std::optional<double> taut_start(const CalibrationUnknown& unknown, double u,
                                 const std::vector<CalibrationPrediction::Stretch>& stretch, double strain) {
  std::size_t nearest = 0;
  for (std::size_t m = 1; m < stretch.size(); ++m)
    if (stretch[m].longest > stretch[nearest].longest) nearest = m;
  if (!(stretch[nearest].longest > 0)) return std::nullopt;
  const auto& member = unknown.members[nearest];
  const double now = unknown.value(member, u), ratio = stretch[nearest].longest / (1 + strain);  // of slack lengths
  double value = 0;
  switch (member.parameter.kind) {
    case Parameter::Kind::slack_length:
      value = now * ratio;
      break;
    case Parameter::Kind::reference_strain:
      value = (1 + now) / ratio - 1;
      break;
    default:
      return std::nullopt;
  }
  const double taut = unknown.u_of(member, value);
  if (!std::isfinite(taut) || taut < unknown.lower || taut > unknown.upper) return std::nullopt;
  return taut;
}

namespace {

/// Of the unknown's strain, by a share: a slack length shorter, a reference strain larger. u itself for other numbers.
double shorter(const CalibrationUnknown& unknown, double u, double share) {
  const auto& member = unknown.members.front();
  const double now = unknown.value(member, u);
  double value = now;
  if (member.parameter.kind == Parameter::Kind::slack_length) value = now * (1 - share);
  if (member.parameter.kind == Parameter::Kind::reference_strain) value = now + share;
  return value == now ? u : std::clamp(unknown.u_of(member, value), unknown.lower, unknown.upper);
}

VecX shorter(const std::vector<CalibrationUnknown>& unknowns, const VecX& u, double share) {
  VecX out = u;
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    out[column] = shorter(unknowns[k], u[column], share);
  }
  return out;
}

std::string shorter_words(double share) { return fmt::format("lengths {:g} % shorter", 100 * share); }

}  // namespace

SolvableStart solvable_start(const CalibrationProblem& problem, const VecX& u) {
  SolvableStart out{problem.at(u, true), ""};
  if (out.at.residuals.size() > 0) return out;
  for (const double share : kShorterLengths) {
    const VecX other = shorter(problem.unknowns(), u, share);
    if (other == u) break;
    CalibrationProblem::At at = problem.at(other, true);
    if (at.residuals.size() > 0) return {std::move(at), shorter_words(share)};
  }
  return out;
}

}  // namespace genu
