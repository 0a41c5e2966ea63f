#include "genu/law/law_kind.h"

#include <cmath>

namespace genu {

std::string LawNumber::unit_name(const std::string& length_name) const {
  switch (unit) {
    case Unit::strain:
    case Unit::number:
      return {};
    case Unit::force:
      return "N";
    case Unit::force_per_length:
      return "N/" + length_name;
    case Unit::force_per_area:
      return "N/" + length_name + "^2";
  }
  return {};
}

double LawNumber::si(double length_unit) const {
  const int power = length_power();
  return power == 0 ? 1 : power == -1 ? 1 / length_unit : 1 / (length_unit * length_unit);
}

std::string LawNumber::fault(double value) const {
  if (std::isfinite(value) && (limit_at_zero ? value >= 0 : value > 0)) return {};
  return key + (limit_at_zero ? " must be >= 0" : " must be > 0");
}

std::optional<double> slack_length_at(std::optional<double> e, double length) {
  if (!e || *e <= -1) return std::nullopt;
  return length / (1 + *e);
}

}  // namespace genu
