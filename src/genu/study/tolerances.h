// Every tolerance of the room `study`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

#include <cstddef>

namespace genu {

// accuracy

/// [1] Spread of times, in the median over settings, from which they are called noisy. Fails first: if too small,
/// warnings about nothing.
inline constexpr double kNoisySpread = 0.25;

/// [1] Least order of convergence that is believed. Fails first: if too small, errors are far too large.
inline constexpr double kMinOrder = 0.5;

/// [1] Largest order that is believed. Fails first: if too large, errors are far too small.
inline constexpr double kMaxOrder = 8;

// import_model

/// [s] Difference of the times of two rows that counts as none. Fails first: if too large, poses and forces of
/// different moments are put together; if too small, files that print fewer digits are refused.
inline constexpr double kSameMoment = 1e-6;

// accuracy_choice

/// [1] Error allowed without a target, over the smallest of all. Fails first: nothing (choice of a setting).
inline constexpr double kErrorFactor = 2;

/// [result's unit] Error that counts as none. Fails first: nothing (choice of a setting).
inline constexpr double kExactError = 1e-6;

/// [1] Ratio of times that count as equal. Fails first: nothing (choice of a setting).
inline constexpr double kTimeFactor = 1.1;

// accuracy_report

/// [result's unit] Error below which all are equal. Fails first: nothing (charts and choice only).
inline constexpr double kErrorRounding = 1e-9;

// accuracy_settings

/// [1] Poisson's ratio of a layer in the place of rigid contact. Fails first: nothing (a convention of accuracy
/// trials).
inline constexpr double kTrialPoisson = 0.45;

/// [m] Its thickness. Fails first: nothing (a convention of accuracy trials).
inline constexpr double kTrialThickness = 6e-3;

/// [mesh unit] Finest mesh of formulas. Fails first: nothing (a convention of accuracy trials).
inline constexpr double kFinestTrialEdge = 0.175;

// accuracy_trials

/// [1] Rounds from which a spread is known. Fails first: if too small, times of one run are believed.
inline constexpr int kMinRounds = 2;

/// [1] Time of a setting, over the scene's own, at which it is given up. Fails first: if too small, accurate settings
/// are missing.
inline constexpr double kTrialPatience = 20;

/// [1] The same for settings that should save time. Fails first: if too small, settings are missing.
inline constexpr double kShortPatience = 4;

/// [s] No setting is given up before. Fails first: if too small, settings are missing.
inline constexpr double kMinPatience = 5;

// evaluate

/// [m] Overlap of rigid surfaces at given poses that is rounding of written numbers: the surfaces are in contact. Fails
/// first: if too small, solved poses are reported as overlapping; if too large, a small overlap is not reported.
inline constexpr double kContactRounding = 1e-9;

// fit_scene

/// [m] Distance of contacts of a pair that makes surfaces of their own. Fails first: if too small, one condyle gets two
/// surfaces.
inline constexpr double kSurfacesApart = 0.015;

/// [1] Cosine of the turn of a body (30 deg) above which one direction cannot describe a zone. Fails first: if too
/// small, poor charts.
inline constexpr double kTurnedCosine = 0.866;

// knee_layout

/// [width] Height of the femur's end in which condyles lie. Fails first: if too large, the shaft moves the layout.
inline constexpr double kCondyleHeight = 0.3;

/// [width] Half width of the band between them. Fails first: if too large, the notch is missed.
inline constexpr double kMiddleBand = 0.08;

/// [width] Half width of the strip between two halves of a bone's end. Fails first: if too small, the notch counts.
inline constexpr double kMiddleStrip = 0.09;

/// [width] How far from the middle the femur's halves go. Fails first: if too large, the epicondyles count.
inline constexpr double kRidgeRim = 0.42;

/// [width] Height of the femur's end whose front is compared. Fails first: if too large, the shaft counts.
inline constexpr double kRidgeHeight = 0.5;

/// [width] Height of the tibia's plateau. Fails first: if too large, the tuberosity counts.
inline constexpr double kPlateauHeight = 0.2;

// layout_doubts

/// [width] Least difference of two halves that tells a left knee from a right one (right knees: the femur 0.020 to
/// 0.074 to the right, the tibia 0.024 to 0.114 to the left). Fails first: if too small, chance decides.
inline constexpr double kSideTold = 0.01;

/// [1] Ratio of the widths of femur and tibia. Fails first: if too small, good pairs get a warning.
inline constexpr double kMaxWidthRatio = 3;

/// [m] Narrowest tibia that is taken for one in the unit that was given or guessed. Fails first: if too large, knees of
/// children get a warning.
inline constexpr double kNarrowestTibia = 0.035;

/// [m] Widest such tibia. Fails first: if too small, large knees get a warning.
inline constexpr double kWidestTibia = 0.13;

/// [1] How much of the ends must face each other. Fails first: if too large, good pairs get a warning.
inline constexpr double kMinFacing = 0.2;

/// [width] Gap between them. Fails first: if too small, good pairs get a warning.
inline constexpr double kMaxStartGap = 0.5;

/// [1] Triangles below which a mesh gets a warning. Fails first: if too large, good meshes get a warning.
inline constexpr std::size_t kFewKneeTriangles = 100;

// run_motion

/// [1] Equal parts of a motion in which the largest error of feedback is compared. Fails first: if too small, a target
/// that moves late looks like growth.
inline constexpr std::size_t kGrowthParts = 4;

/// [1] Growth from part to part that is called unstable. Fails first: if too small, slow targets are; if too large, a
/// slowly growing oscillation is not seen.
inline constexpr double kGrowth = 1.3;

/// [largest factor asked for] Factor of feedback that has run away from its target. Fails first: if too small, a target
/// that others hold back is; if too large, a motion that stops early is not told why.
inline constexpr double kRunaway = 100;

/// [1] Energy error that is always allowed. Fails first: if too small, good motions are rejected.
inline constexpr double kMinEnergyError = 1e-3;

/// [1] Energy error over the tolerance. Fails first: if too small, good motions are rejected.
inline constexpr double kEnergyOfTolerance = 1e3;

/// [1] Energy error of motions with layers, which sum to a relative error only. Fails first: if too small, good motions
/// are rejected.
inline constexpr double kLayerEnergyError = 1e-2;

// run_scene

/// [m] Overlap of a start that is refused above it. Fails first: if too small, starts that solve are refused.
inline constexpr double kMaxStartOverlap = 6e-3;

// sensitivity

/// [1] Contacts of a pair that can be named before the run has found them. Fails first: if too small, a name is
/// refused.
inline constexpr int kMaxNamedContacts = 99;

/// [1] Largest sensitivity.csv. Fails first: if too large, the disk is full.
inline constexpr std::size_t kMaxSensitivityRows = 5000000;

// laxity

/// [1] Sine of the angle, or cosine, within which two axes are parallel, or perpendicular. Fails first: if too small, a
/// knee with axes written to few digits gets its varus moment about the tibia's anterior axis.
inline constexpr double kSameAxis = 1e-6;

/// [1] Sine of the angle between a joint's first rotation and the femur's flexion axis, up to which laxity takes it for
/// flexion: 6 deg. Fails first: if too small, a knee with measured anatomical axes is refused.
inline constexpr double kFlexionTilt = 0.1;

/// [of the full load] Difference of two loads that are the same. Fails first: if too large, neighbouring rows are one.
inline constexpr double kSameLoad = 1e-9;

/// [rad] Difference of two angles that are the same. Fails first: if too large, neighbouring rows are one.
inline constexpr double kSameFlexion = 1e-9;

/// [rad] Most that the knee bends between two rows of an envelope, 2 deg. Fails first: nothing (rows only).
inline constexpr double kEnvelopeStep = 0.0349065850398866;

/// [m or rad] Distance between loading and unloading above which both are drawn. Fails first: nothing (pictures).
inline constexpr double kVisibleLoop = 1e-6;

}  // namespace genu
