// Every tolerance of the room `core`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

namespace genu {

// least_squares

/// [1] Largest Marquardt damping tried before the fit stops. Fails first: if too small, a fit stops away from its
/// minimum; if too large, useless trials at the end.
inline constexpr double kMaxLeastSquaresDamping = 1e12;

/// [1] Below this damping a short step means convergence, not a restricted step. Fails first: if too large, a
/// restricted step passes for convergence.
inline constexpr double kFreeStepDamping = 1e-2;

/// [of the sum of squares] A step that gains less creeps, if it also gains less than kCreepShare. Fails first: if too
/// large, a fit along a curved valley is given up; if too small, fits at an edge take all iterations.
inline constexpr double kCreep = 1e-3;

/// [of the sum of squares] What a step without damping promises where steps creep. Fails first: if too small, the last
/// steps of a fit to noise, most of which no step can lower, count as creeping.
inline constexpr double kCreepPromise = 0.01;

/// [of what a step without damping promises] See kCreep. Fails first: if too large, the last steps before a minimum
/// count as creeping.
inline constexpr double kCreepShare = 0.2;

/// [1] Turns through all unknowns in which a step that bounds stop is made the best within them. Fails first: if too
/// small, a fit ends at a bound that it should leave.
inline constexpr int kReleaseSweeps = 200;

/// [1] How many times as much such a step has to promise. Fails first: if too large, as above; if too small, directions
/// without certain derivatives are stepped along.
inline constexpr double kReleaseGain = 2;

/// [1] Component of an undetermined direction (unit vector) that counts as part of it. Fails first: if too small,
/// round-off names parameters that the data determine.
inline constexpr double kUndeterminedShare = 1e-3;

// pose

/// [rad] Below it exp and log of rotations use their series: the next term, angle^4/120, is below 1e-18. Fails first:
/// if too large, rotation vectors lose digits.
inline constexpr double kSeriesAngle = 1e-4;

/// [1] Below it 2 atan(s/w)/s is taken as 2/w. Fails first: if too large, logarithms of small rotations lose digits.
inline constexpr double kSeriesSine = 1e-8;

}  // namespace genu
