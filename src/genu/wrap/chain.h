// The first string over obstacles: a chain of points, lifted over each obstacle on its side and shortened.
//
// Newton's method alone would find any geodesic, also the long way round a thin obstacle. A chain that is shortened
// (each point toward the middle of its neighbours, and put onto the surface from within) arrives near a shortest one.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "genu/wrap/taut_string.h"

namespace genu {

/// What a string does at one obstacle.
struct Touch {
  bool touching = false;
  Geodesic arc;  ///< where it touches: in the frame of the obstacle's body
};

/// A side of an obstacle that a string passes: a direction in its body, from the middle of the obstacle; empty: any.
using WrapSide = std::optional<Vec3>;

/// The string between two points over obstacles in order, on the given sides; the shortest of the sides tried where
/// none is given. Empty where none is found. Each touch is solved to rounding.
std::optional<std::vector<Touch>> first_string(const Vec3& from, const Vec3& to, std::span<const Obstacle> obstacles,
                                               std::span<const WrapSide> sides);

/// Lets go of arcs of negative length and adds obstacles that a line cuts, until neither is left. False where the
/// string is not found. `touches` begins as the string of a pose nearby.
[[nodiscard]] bool settle_touches(const Vec3& from, const Vec3& to, std::span<const Obstacle> obstacles,
                                  std::span<Touch> touches);

/// Solves the touching arcs as they are, whatever the signs of their lengths.
[[nodiscard]] bool solve_touches(const Vec3& from, const Vec3& to, std::span<const Obstacle> obstacles,
                                 std::span<Touch> touches);

/// m: length of the string.
double length_of(const Vec3& from, const Vec3& to, std::span<const Obstacle> obstacles, std::span<const Touch> touches);

/// The clearance (m) of the line that passes obstacle i, which the string does not touch, and the arc of length 0 where
/// it is nearest.
double clearance_at(const Vec3& from, const Vec3& to, std::span<const Obstacle> obstacles,
                    std::span<const Touch> touches, std::size_t i, Geodesic& nearest);

}  // namespace genu
