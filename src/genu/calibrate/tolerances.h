// Every tolerance of the room `calibrate`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

#include <array>

namespace genu {

// calibration_unknowns

/// [standard change] Scale of a varied number that may be zero: 1 cm, 0.1 of strain, 10 N. Fails first: if too small,
/// slow fits.
inline constexpr double kUnknownScale = 10;

/// [1] Largest change of a logarithm in a step (a factor of 2.7). Fails first: if too large, a stiff motion takes for
/// ever.
inline constexpr double kMaxLogStep = 1;

/// [1] Largest change of a ligament's strain in a step. Fails first: if too large, ligaments become slack on the way
/// and have no derivative any more; if too small, slow fits.
inline constexpr double kMaxStrainStep = 0.02;

// calibration_search

/// [1] Error of central differences over the largest derivative. Fails first: if too small, undetermined numbers are
/// called determined.
inline constexpr double kDerivativeNoise = 1e-6;

/// [1] Error of exact derivatives over the largest: that of the solver's poses. Fails first: if too small, undetermined
/// numbers are called determined; if too large, weak ones are not fitted.
inline constexpr double kExactDerivativeNoise = 1e-9;

/// [1] Strain that a ligament slack in every pose gets where it is longest, to be fitted again from there. Fails first:
/// if too small, a law with a toe still pulls too little to be seen; if too large, the new start is far off.
inline constexpr double kTautStrain = 0.005;

/// [1] Fits again from taut starts, as long as each is better than the one before. Fails first: if too small, a second
/// ligament that the first one has made slack stays so.
inline constexpr int kTautRounds = 4;

/// [1] How often a ligament that becomes slack in every pose during a fit is made taut at once. Fails first: if too
/// small, the others creep to a false minimum; if too large, slow fits of ligaments that are slack in truth.
inline constexpr int kTautOnTheWay = 2;

/// [1] By how much slack lengths are shortened where a start has rows that cannot be solved, one after the other. Fails
/// first: if too small, starts are refused; if too large, new starts are far off.
inline constexpr std::array<double, 3> kShorterLengths = {0.02, 0.04, 0.08};

/// [1] After a fit that did not converge: least strains that all ligaments get where they are longest, one start after
/// the other. 0: the start itself, not held. Fails first: if too small, the same ligaments become slack again; if too
/// large, the start is far off.
inline constexpr std::array<double, 3> kTautAgain = {0, 0.03, 0.06};

/// [1] Shares of the sum of squares with which slack lengths are held near their start, one after the other. Fails
/// first: if too small, weak ligaments run off to a false minimum; if too large, slow fits.
inline constexpr std::array<double, 3> kHeldShares = {0.1, 0.01, 0.001};

/// [standard change] How far from its start a slack length may be, roughly, while it is held: 5 %, 0.05 of strain.
/// Fails first: if too small, the held fits stay at the start; if too large, they do not hold.
inline constexpr double kHeldChange = 5;

/// [1] Iterations of each held fit. Fails first: if too small, the start moves too little; if too large, slow fits.
inline constexpr int kHeldIterations = 4;

/// [of the sum of squares] From here on nothing is held any more. Fails first: if too small, slow fits.
inline constexpr double kHeldEnough = 1e-3;

/// [1] Share of the target's rows that may be missing at a step, as where a curve ends early. Fails first: if too
/// small, fits end at the edge of where all rows exist; if too large, they wander where few do.
inline constexpr double kMostMissingRows = 0.25;

/// [1] Steps that creep (core's kCreep), one after the other, after which another start is tried. Fails first: if too
/// small, fits are given up in curved valleys; if too large, slow fits.
inline constexpr int kMostCreeping = 6;

/// [of the sum of squares] By how much a taut start must be better. Fails first: if too large, a weak ligament stays
/// slack.
inline constexpr double kWorthATautStart = 1e-6;

/// [errors of measurement, or spread] Root mean square of residuals that is round-off. Fails first: if too small, a
/// length that nothing depends on is fitted to round-off; if too large, a ligament that is a little too long stays so.
inline constexpr double kNoResidual = 1e-9;

// calibration_reader

/// [column's unit] Least error of measurement that can be stated. Fails first: if too small, its square is 0.
inline constexpr double kLeastError = 1e-12;

// calibration_design

/// [standard change] How well a number without a prior counts as known before anything is measured: 10 % of a length,
/// 0.1 of strain. Fails first: if too small, tests that would determine such a number seem to be worth little.
inline constexpr double kUnknownBefore = 10;

/// [1] Tests that are chosen one after another. Fails first: nothing (words only).
inline constexpr int kDesignSteps = 5;

// calibration_forward

/// [1] Samples of the study that draws fitted numbers. Fails first: nothing (the study's file says it and can be
/// changed).
inline constexpr int kForwardSamples = 200;

// calibration_report

/// [1] Component from which a parameter is named. Fails first: if too small, every parameter is named.
inline constexpr double kNamedComponent = 0.05;

/// [of the prior's SD] Standard error from which a number is known by its prior alone. Fails first: if too small, what
/// the target narrows is said to be unknown to it.
inline constexpr double kPriorRules = 0.99;

/// [1] Standard error of the direction that is determined least over that of the best, from which it is named. Fails
/// first: nothing (words only).
inline constexpr double kPoorDirection = 100;

/// [standard deviations of the sum of squares] From which residuals are beyond the stated errors. Fails first: if too
/// small, good fits are doubted.
inline constexpr double kMisfit = 5;

// calibration_target

/// [interval] Difference of times that is round-off. Fails first: if too small, rows of a curve are interpolated or
/// refused.
inline constexpr double kSameTime = 1e-9;

/// [1] Spread of a column over its largest value that is none. Fails first: if too small, a constant column is scaled
/// by round-off.
inline constexpr double kConstantSpread = 1e-9;

}  // namespace genu
