// Beyond what an answer is doubted: limits of common sense, none of which refuses a pose.
#pragma once

#include <array>
#include <numbers>

namespace genu {

struct PlausibleDef {
  double strain = 0.3;                     ///< of a ligament
  double ligament_force = 5e3;             ///< N, of one
  double contact_force = 50;               ///< of one contact, in sums of all loads
  double pressure = 30e6;                  ///< Pa, of a layer
  double travel = 0.03;                    ///< m, of a contact over both its surfaces from where it began
  double rotation = std::numbers::pi / 4;  ///< rad, of a joint about what is not prescribed, from where it began
};

/// The keys of [plausible].
struct PlausibleKey {
  enum class Unit { none, newton, megapascal, length, angle };
  const char* key;
  Unit unit;
  double PlausibleDef::*member;
};
inline constexpr std::array<PlausibleKey, 6> kPlausibleKeys = {{
    {"strain", PlausibleKey::Unit::none, &PlausibleDef::strain},
    {"ligament_force", PlausibleKey::Unit::newton, &PlausibleDef::ligament_force},
    {"contact_force", PlausibleKey::Unit::none, &PlausibleDef::contact_force},
    {"pressure", PlausibleKey::Unit::megapascal, &PlausibleDef::pressure},
    {"travel", PlausibleKey::Unit::length, &PlausibleDef::travel},
    {"rotation", PlausibleKey::Unit::angle, &PlausibleDef::rotation},
}};

}  // namespace genu
