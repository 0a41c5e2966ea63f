// Factors from the units people write to SI: value_SI = value * factor.
#pragma once

#include <numbers>

namespace genu::units {

inline constexpr double kMetre = 1;
inline constexpr double kMillimetre = 1e-3;
inline constexpr double kRadian = 1;
inline constexpr double kDegree = std::numbers::pi / 180;

}  // namespace genu::units
