// The shortest path between two points outside obstacles: straight, along a geodesic of each obstacle it touches,
// straight. Frictionless, so one tension all along.
//
// Unknown of each arc are natural variations of its geodesic (Scholz et al. 2015): its begin A along t and b, its
// direction theta, and its length. Conditions are that the leg d that arrives at A, and the one that leaves the other
// end B, lie in the tangent line there:
//
//   d . n = d . b = 0                       at A and at B: four for each arc
//
// Newton's method with exact derivatives; it stays regular where an arc has length 0, and beyond, where the length is
// negative: a string that is about to leave is the smooth continuation of one that touches.
//
// The second derivatives of the length need only moves across the string, y at A and c y + a theta at B: to slide along
// it changes nothing to second order. Their matrix H (two rows for each arc) has, with leg lengths l,
//
//   an arc:   c c' y^2 + 2 a c' y theta + a a' theta^2
//   a leg:    |y_X b_X - y_Y b_Y|^2 / l     (y = 0 at a fixed end)
//
// The string is a strict local minimum where H is positive definite and no arc has a conjugate point.
#pragma once

#include <array>
#include <span>

#include "genu/core/pose.h"
#include "genu/wrap/geodesic.h"

namespace genu {

/// An obstacle of a string where it is in the world.
struct Obstacle {
  const Surface* surface = nullptr;
  Pose X_W;  ///< of the body that carries it
};

/// Most arcs between two fixed points.
inline constexpr int kMostArcs = 8;

/// The second derivatives of the length of a string by moves across it: for each arc y (m) at its begin, and theta
/// times the root of |a|, so that nothing vanishes where an arc has length 0.
struct StringHessian {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2 * kMostArcs, 2 * kMostArcs>;
  Matrix H;
  /// How far, along b, the begin and the end of arc i move for its two variables.
  std::array<Vec2, kMostArcs> at_begin, at_end;
};

/// Finds the arcs from those given, which it replaces: one for each obstacle, of which begin.p, begin.t and length
/// count. In the frames of the obstacles' bodies. False where Newton's method does not arrive; they are then
/// unspecified.
[[nodiscard]] bool solve_string(const Vec3& from, const Vec3& to, std::span<const Obstacle> obstacles,
                                std::span<Geodesic> arcs);

/// m: legs and arcs.
double string_length(const Vec3& from, const Vec3& to, std::span<const Obstacle> obstacles,
                     std::span<const Geodesic> arcs);

/// H of a solved string.
void string_hessian(const Vec3& from, const Vec3& to, std::span<const Obstacle> obstacles,
                    std::span<const Geodesic> arcs, StringHessian& out);

/// Whether a solved string with arcs of positive length is a strict local minimum.
bool is_shortest_nearby(const StringHessian& hessian, std::span<const Geodesic> arcs);

/// The least eigenvalue of H over the largest: 0 where the string is about to slip off.
double least_hold(const StringHessian& hessian);

/// The least gap (m) of a surface to the straight line between two points of its body, where it is known; `along` is
/// where, 0 to 1. Infinite where the line stays out of the band in which the surface knows its gap.
double line_clearance(const Surface& surface, const Vec3& from, const Vec3& to, double& along);

}  // namespace genu
