// Names and units of the columns that several tables have.
#pragma once

#include <numbers>
#include <string>

#include "genu/scene/scene.h"

namespace genu {

inline constexpr double kInMillimetres = 1e3;                 ///< mm per m
inline constexpr double kInDegrees = 180 / std::numbers::pi;  ///< deg per rad

/// "knee.flexion_deg", "knee.x_mm"
inline std::string coordinate_column(const Scene& scene, const QuantityRef& c) {
  return quantity_name(scene, c) + (c.is_rotation() ? "_deg" : "_mm");
}

/// A value (rad or m) in the unit of its column.
inline double shown(const QuantityRef& c, double value) {
  return value * (c.is_rotation() ? kInDegrees : kInMillimetres);
}

}  // namespace genu
