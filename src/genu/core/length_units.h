// The units of length that files of meshes may be in.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace genu {

struct LengthUnit {
  const char* name;
  double metres;  ///< in one of it
};

/// In the order in which a size is tried in them.
inline constexpr std::array<LengthUnit, 5> kLengthUnits{
    {{"mm", 1e-3}, {"m", 1.0}, {"cm", 1e-2}, {"inch", 0.0254}, {"um", 1e-6}}};

std::vector<std::string> length_unit_names();

/// Metres in a unit; empty for a word that is none of the names.
[[nodiscard]] std::optional<double> metres_in(std::string_view unit);

/// The name of the unit of so many metres, which must be one of kLengthUnits.
[[nodiscard]] const char* length_unit_name(double metres);

}  // namespace genu
