#include "genu/core/length_units.h"

#include <cassert>

namespace genu {

std::vector<std::string> length_unit_names() {
  std::vector<std::string> names;
  for (const LengthUnit& unit : kLengthUnits) names.emplace_back(unit.name);
  return names;
}

std::optional<double> metres_in(std::string_view unit) {
  for (const LengthUnit& known : kLengthUnits)
    if (unit == known.name) return known.metres;
  return std::nullopt;
}

const char* length_unit_name(double metres) {
  for (const LengthUnit& known : kLengthUnits)
    if (metres == known.metres) return known.name;
  assert(false);
  return kLengthUnits.front().name;
}

}  // namespace genu
