// The string over one sphere or cylinder, in closed form: tangents in a plane across the axis, and the arc between
// them.
#pragma once

#include "genu/wrap/geodesic.h"

namespace genu {

/// Moves `arc` to where it is taut between two points of the obstacle's body, on the side on which arc.begin and
/// arc.length have it; there arc.length may be negative. Of the arc only begin.p, begin.t and length are set. False
/// where a point lies inside, the sense of the arc is not defined, or the string lies within a hollow.
[[nodiscard]] bool place_round_arc(const RoundShape& shape, const Vec3& from, const Vec3& to, Geodesic& arc);

}  // namespace genu
