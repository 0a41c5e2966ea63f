#include "genu/model/load_scale.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "genu/model/tolerances.h"

namespace genu {

std::optional<LoadScale> LoadScale::make(const ScaleDef& def, std::string& why) {
  LoadScale scale;
  scale.kind_ = def.kind;
  scale.start_ = def.start;
  if (def.kind == ScaleDef::Kind::sine) {
    scale.amplitude_ = def.amplitude;
    scale.offset_ = def.offset;
    scale.angular_frequency_ = 2 * std::numbers::pi * def.frequency;
    scale.knots_ = {def.start};
    scale.largest_ = std::abs(def.amplitude) + std::abs(def.offset);
    return scale;
  }
  if (def.kind == ScaleDef::Kind::step) {
    scale.from_ = def.from;
    scale.to_ = def.to;
    scale.rise_ = def.rise;
    scale.knots_ = {def.start, def.start + def.rise};
    scale.largest_ = std::max(std::abs(def.from), std::abs(def.to));
    return scale;
  }
  if (def.kind == ScaleDef::Kind::feedback) {
    const auto target = make(*def.target, why);
    if (!target) return std::nullopt;
    scale.target_ = std::make_shared<const LoadScale>(*target);
    scale.coordinate_ = def.coordinate;
    scale.gain_ = def.gain;
    scale.rate_gain_ = def.rate_gain;
    scale.largest_ = def.gain * std::max(target->largest(), kFeedbackError);
    return scale;
  }
  scale.table_ = MonotoneTable::make(def.table, why);
  if (!scale.table_) return std::nullopt;
  if (def.kind == ScaleDef::Kind::over_coordinate) scale.coordinate_ = def.coordinate;
  scale.first_ = def.table.front().first;
  scale.last_ = def.table.back().first;
  for (const auto& [x, factor] : def.table) {
    scale.largest_ = std::max(scale.largest_, std::abs(factor));
    scale.knots_.push_back(x);
  }
  return scale;
}

LoadScale::Value LoadScale::evaluate(double x) const {
  switch (kind_) {
    case ScaleDef::Kind::sine:
      return sine(x);
    case ScaleDef::Kind::step:
      return step(x);
    case ScaleDef::Kind::over_coordinate:
    case ScaleDef::Kind::over_time:
    case ScaleDef::Kind::feedback:
      break;
  }
  return table(x);
}

LoadScale::Value LoadScale::evaluate(double x, double time) const {
  if (!target_) return evaluate(coordinate_ ? x : time);
  return {gain_ * (target_->evaluate(time).factor - x), -gain_, 0};
}

double LoadScale::rate_in_time(double time, double slope) const {
  if (target_) return gain_ * target_->evaluate(time).slope;
  return coordinate_ ? 0 : slope;
}

double LoadScale::rate_term(double time, double rate) const {
  return has_rate() ? rate_gain_ * (target_->evaluate(time).slope - rate) : 0;
}

std::vector<double> LoadScale::nonsmooth_points_in_time() const {
  if (target_) return target_->nonsmooth_points_in_time();
  return coordinate_ ? std::vector<double>() : knots_;
}

double LoadScale::period() const {
  if (target_) return target_->period();
  return kind_ == ScaleDef::Kind::sine ? 2 * std::numbers::pi / angular_frequency_ : 0;
}

LoadScale::Value LoadScale::table(double x) const {
  const MonotoneTable::Value value = table_->evaluate(std::clamp(x, first_, last_));
  const bool inside = x > first_ && x < last_;
  return {value.y, inside ? value.slope : 0, inside ? value.curvature : 0};
}

std::vector<LoadScale::NonsmoothPoint> LoadScale::nonsmooth_points_over_coordinate() const {
  if (!coordinate_ || target_) return {};
  return {{first_, 0, table_->evaluate(first_).slope}, {last_, table_->evaluate(last_).slope, 0}};
}

LoadScale::Value LoadScale::sine(double x) const {
  if (x < start_) return {offset_, 0, 0};
  const double w = angular_frequency_, phase = w * (x - start_);
  return {offset_ + amplitude_ * std::sin(phase), amplitude_ * w * std::cos(phase),
          -amplitude_ * w * w * std::sin(phase)};
}

/// The quintic polynomial with zero speed and acceleration at both ends.
LoadScale::Value LoadScale::step(double x) const {
  if (x < start_) return {from_, 0, 0};
  if (x >= start_ + rise_) return {to_, 0, 0};
  const double u = (x - start_) / rise_, height = to_ - from_;
  return {from_ + height * u * u * u * (10 + u * (6 * u - 15)), height * 30 * u * u * (1 - u) * (1 - u) / rise_,
          height * 60 * u * (1 - u) * (1 - 2 * u) / (rise_ * rise_)};
}

}  // namespace genu
