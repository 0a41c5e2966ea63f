// Factors between SI and the units people write and read: value_SI = value * units::k..., value = value_SI * to::k...
#pragma once

#include <numbers>

namespace genu::units {

inline constexpr double kMetre = 1;
inline constexpr double kMillimetre = 1e-3;
inline constexpr double kRadian = 1;
inline constexpr double kDegree = std::numbers::pi / 180;
inline constexpr double kMegapascal = 1e6;

}  // namespace genu::units

namespace genu::to {

inline constexpr double kMillimetre = 1e3;
inline constexpr double kSquareMillimetre = 1e6;
inline constexpr double kDegree = 180 / std::numbers::pi;
inline constexpr double kMillijoule = 1e3;  // = N mm

}  // namespace genu::to
