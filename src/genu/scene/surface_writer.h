// A polynomial surface as the table of a scene file that reads back as the same surface.
#pragma once

#include <string>
#include <string_view>

#include "genu/scene/scene.h"

namespace genu {

/// `text` in quotes, escaped so that TOML (and JSON) reads it back; what is no UTF-8 becomes '?'.
std::string toml_string(std::string_view text);

/// [surface.NAME] of `def`, a polynomial of either chart, on the body of that name; lengths in units of `length_unit`
/// (m), angles of the patch in units of `angle_unit` (rad). Numbers have as many digits as bring back the same double.
std::string polynomial_table(const SurfaceDef& def, const std::string& body, double length_unit, double angle_unit);

}  // namespace genu
