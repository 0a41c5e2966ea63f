#include "genu/model/load_scale.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace genu {

std::optional<LoadScale> LoadScale::make(const ScaleDef& def, std::string& why) {
  LoadScale scale;
  if (def.kind == ScaleDef::Kind::sine) {
    scale.amplitude_ = def.amplitude;
    scale.angular_frequency_ = 2 * std::numbers::pi * def.frequency;
    scale.start_ = def.start;
    scale.knots_ = {def.start};
    scale.largest_ = std::abs(def.amplitude);
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
  if (!table_) {
    if (x < start_) return {0, 0};
    const double phase = angular_frequency_ * (x - start_);
    return {amplitude_ * std::sin(phase), amplitude_ * angular_frequency_ * std::cos(phase)};
  }
  const MonotoneTable::Value value = table_->evaluate(std::clamp(x, first_, last_));
  return {value.y, x > first_ && x < last_ ? value.slope : 0};
}

}  // namespace genu
