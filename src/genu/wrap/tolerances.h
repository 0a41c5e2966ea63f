// Every tolerance of the room `wrap`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

namespace genu {

// geodesic

/// [smooth length] Longest Runge-Kutta step of a geodesic on a blend of pieces. Fails first: if too large, forces of
/// strings on meshes are noisy; if too small, they cost more.
inline constexpr double kGeodesicStep = 0.5;

/// [1] Error of one extrapolated step of a geodesic: lengths over the radius of curvature, angles in rad. Fails first:
/// if too large, the lengths of wrapped strings lose digits.
inline constexpr double kGeodesicError = 1e-12;

/// [rad] Turn of the first extrapolated step. Fails first: if too large, steps are tried in vain.
inline constexpr double kFirstStepTurn = 0.7;

/// [1] Most steps of one geodesic. Fails first: if too small, long geodesics over sharp edges fail.
inline constexpr int kMaxGeodesicSteps = 500;

/// [1] Least tangential part of a direction. Fails first: if too small, directions of round-off.
inline constexpr double kLeastTangent = 1e-8;

// arc_change

/// [rad] Turn of the arc that one rule of five points integrates. Fails first: if too large, derivatives by the numbers
/// of a wrapped surface lose digits.
inline constexpr double kChangeTurn = 0.3;

// taut_string

/// [1] Steps of Newton's method for a string. Fails first: if too small, strings from far starts fail.
inline constexpr int kMaxStringSteps = 60;

/// [1] Halvings of one such step. Fails first: if too small, strings from far starts fail.
inline constexpr int kMaxStringHalvings = 10;

/// [rad] Turn of an arc in one step. Fails first: if too large, Newton's method leaves for another side.
inline constexpr double kMostStringTurn = 0.5;

/// [rad] Largest angle between a leg and the tangent line of a settled string. Fails first: if too small, iterations
/// without effect; if too large, forces lose digits.
inline constexpr double kStringSettled = 1e-14;

/// [rad] The same where rounding ends the iterations: far from the world's origin, or with short legs. Fails first: if
/// too small, good strings are refused.
inline constexpr double kStringRounding = 1e-9;

/// [rad] Largest angle from which the last step of a string moves its ends along Jacobi fields, without following its
/// geodesics again. Fails first: if too large, stiffnesses lose digits; if too small, strings cost one geodesic more.
inline constexpr double kStringSlide = 1e-11;

/// [1] Error of the geodesics of a trial string over the square of the largest angle before, which Newton's method
/// leaves. Fails first: if too large, one trial more; if too small, trials that are more exact than they need to be.
inline constexpr double kTrialError = 1e-2;

/// [radius of curvature, rad] Difference of a surface from what it was at an end of an arc that counts as none. Fails
/// first: if too large, arcs of other parameters are taken over; if too small, arcs are followed once more in vain.
inline constexpr double kArcUnchanged = 1e-11;

/// [m] Radius of what is called flat in this comparison. Fails first: if too large, a surface that has moved without a
/// turn passes for unchanged where it is flat.
inline constexpr double kFlatReach = 0.1;

/// [1] Looks along a line for its clearance from a closed form. Fails first: if too small, one of several places where
/// a line cuts is missed.
inline constexpr int kClearanceLooks = 8;

/// [smooth length] Distance of the looks along a line beside a blend. Fails first: if too large, a line that cuts is
/// called clear.
inline constexpr double kClearanceStep = 0.5;

/// [1] Steps to the place where a line is nearest. Fails first: if too small, the depth of a line that cuts is too
/// small.
inline constexpr int kMaxClearanceSteps = 60;

/// [1] Slope of the gap at that place. Fails first: if too large, the depth of a line that cuts is too small.
inline constexpr double kClearanceSlope = 1e-12;

// chain

/// [1] Nodes of the first chain of a string, doubled where Newton's method does not arrive from it. Fails first: if too
/// small, strings over thin obstacles begin on the wrong side.
inline constexpr int kChainNodes = 32;

/// [1] Doublings of them. Fails first: if too small, strings over thin obstacles are not found.
inline constexpr int kChainDoublings = 2;

/// [1] Rounds in which a chain is shortened, for each node. Fails first: if too small, the chain is not yet short.
inline constexpr int kChainRounds = 8;

/// [1] Over-relaxation while a chain is shortened. Fails first: if too large, it does not settle.
inline constexpr double kChainRelaxation = 1.6;

/// [smooth length] Farthest move of a node beside a blend. Fails first: if too large, nodes leap through the band.
inline constexpr double kChainMove = 0.5;

/// [m] Depth of a line that cuts which is round-off: it may begin on the surface, where that is named twice. Fails
/// first: if too small, a line beside a touching point is called cut.
inline constexpr double kClearanceRounding = 1e-14;

/// [1] Sides that a string without a given one is tried on. Fails first: if too small, the shortest side is missed.
inline constexpr int kSidesTried = 8;

/// [1] Steps in which a chain is lifted over an obstacle. Fails first: if too small, the chain begins far from it.
inline constexpr int kLiftSteps = 20;

}  // namespace genu
