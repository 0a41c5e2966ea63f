#include "genu/calibrate/calibration_experiment.h"

#include <algorithm>
#include <cmath>

#include "genu/scene/words.h"

namespace genu {
namespace {

bool sets_slack_length(const Parameter& p) {
  return p.kind == Parameter::Kind::slack_length || p.kind == Parameter::Kind::reference_strain ||
         p.kind == Parameter::Kind::reference_force;
}

}  // namespace

ScenesUnknowns::ScenesUnknowns(Prepared base, const std::vector<CalibrationUnknown>& unknowns)
    : base_(std::move(base)), unknowns_(unknowns) {
  const std::vector<Parameter> all = parameters_of(base_.source);
  for (const CalibrationUnknown& u : unknowns) {
    own_.emplace_back();
    for (const auto& member : u.members) {
      const auto same = [&](const Parameter& p) { return p.name == member.parameter.name; };
      const auto found = std::find_if(all.begin(), all.end(), same);
      const bool has = found != all.end() && parameter_number(base_.source, *found) != nullptr;
      own_.back().push_back(has ? std::optional(*found) : std::nullopt);
      none_ = none_ && !has;
    }
  }
}

std::optional<Prepared> ScenesUnknowns::with(const VecX& u) const {
  std::vector<NewNumber> numbers;
  for (std::size_t k = 0; k < unknowns_.size(); ++k)
    for (std::size_t m = 0; m < own_[k].size(); ++m)
      if (own_[k][m])
        numbers.emplace_back(*own_[k][m], unknowns_[k].value(unknowns_[k].members[m], u[static_cast<Eigen::Index>(k)]));
  Diagnostics unused;
  auto changed = with_numbers(base_, numbers, unused);
  if (changed) changed->steps = base_.steps;
  return changed;
}

std::optional<MatX> ScenesUnknowns::rates(Sensitivity& sensitivity, const VecX& u, const PosePoint& point,
                                          const std::vector<Output>& outputs) const {
  if (!sensitivity.factor(point)) return std::nullopt;
  MatX out = MatX::Zero(static_cast<Eigen::Index>(outputs.size()), u.size());
  for (std::size_t k = 0; k < unknowns_.size(); ++k)
    for (std::size_t m = 0; m < own_[k].size(); ++m) {
      if (!own_[k][m]) continue;
      const auto column = static_cast<Eigen::Index>(k);
      const double slope = unknowns_[k].slope(unknowns_[k].members[m], u[column]);
      sensitivity.differentiate(*own_[k][m]);
      for (std::size_t o = 0; o < outputs.size(); ++o)
        out(static_cast<Eigen::Index>(o), column) += outputs[o].rate(point, sensitivity) * outputs[o].shown * slope;
    }
  return out;
}

std::optional<MatX> ScenesUnknowns::derivatives(Sensitivity& sensitivity, const VecX& u, const PosePoint& point,
                                                const std::vector<Output>& outputs) const {
  auto out = rates(sensitivity, u, point, outputs);
  if (out && !out->allFinite()) out.reset();
  return out;
}

void ScenesUnknowns::note_stretch(const Prepared& at_u, const State& state, CalibrationPrediction& out) const {
  for (std::size_t k = 0; k < own_.size(); ++k)
    for (std::size_t m = 0; m < own_[k].size(); ++m) {
      if (!own_[k][m] || !sets_slack_length(*own_[k][m])) continue;
      const auto& ligament = at_u.model.ligaments[at(own_[k][m]->object)];
      const double length = ligament.path.length(state.poses, state.wraps);
      CalibrationPrediction::Stretch& s = out.stretch[k][m];
      s.longest = std::max(s.longest, length / ligament.law.slack_length());
      s.slack = s.slack && ligament.law.evaluate(length).force == 0;
    }
}

std::vector<std::vector<CalibrationPrediction::Stretch>> ScenesUnknowns::no_stretch() const {
  std::vector<std::vector<CalibrationPrediction::Stretch>> out;
  out.reserve(own_.size());
  for (const auto& members : own_) out.emplace_back(members.size());
  return out;
}

void CalibrationExperiment::state_errors(const std::vector<std::pair<std::string, double>>& errors) {
  for (Column& column : columns_)
    for (const auto& [name, error] : errors)
      if (matches(name, column.name)) column.scale = error, column.stated = true;
}

VecX CalibrationExperiment::wanted() const {
  VecX out(static_cast<Eigen::Index>(values_.size()));
  for (std::size_t k = 0; k < values_.size(); ++k) out[static_cast<Eigen::Index>(k)] = values_[k].wanted;
  return out;
}

VecX CalibrationExperiment::scales() const {
  VecX out(static_cast<Eigen::Index>(values_.size()));
  for (std::size_t k = 0; k < values_.size(); ++k)
    out[static_cast<Eigen::Index>(k)] = columns_[values_[k].column].scale;
  return out;
}

}  // namespace genu
