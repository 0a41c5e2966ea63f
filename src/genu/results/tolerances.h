// Every tolerance of the room `results`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

#include <cstddef>

namespace genu {

// calibration_table

/// [1] Correlation of two parameters from which it is reported. Fails first: if too small, warnings about nothing.
inline constexpr double kCloseCorrelation = 0.99;

// curves

/// [deg] Least change of an angle to be the axis of curves. Fails first: nothing (choice of the axis).
inline constexpr double kMinDrivenAngle = 5;

// error_bars

/// [1] Richardson's 1 / (1.5 - 1) for an error of first order in the edges. Fails first: if too small, error bars of
/// meshes are too short.
inline constexpr double kMeshFactor = 2;

/// [1] Standard deviations of an error bar of noise. Fails first: if too small, error bars of noise are too short.
inline constexpr double kNoiseDeviations = 2;

/// [rows] Neighbouring rows whose errors count. Fails first: if too small, gaps in error bars.
inline constexpr std::size_t kBesideRows = 1;

// report_pressures

/// [m] Distance of two places on a surface that are one node of its lattice. Fails first: if too small, a node is a
/// new place in every row, and the page grows.
inline constexpr double kSameSite = 1e-6;

// sensitivity_table

/// [1] Difference of two effects over the largest that is round-off. Fails first: if too small, symmetric parameters
/// are ranked apart.
inline constexpr double kSameEffect = 1e-8;

/// [1] Ratio of largest effects of parameters that may be alike. Fails first: if too large, symmetric parameters are
/// ranked apart.
inline constexpr double kNearEffect = 1 - 1e-6;

/// [1] Effect over the largest that is none. Fails first: if too small, parameters without effect are ranked.
inline constexpr double kEffectRounding = 1e-12;

// report_plots

/// [mm or 1] Moment arm that is drawn: less is round-off. Fails first: if too small, flat lines are drawn.
inline constexpr double kLeastDrawnArm = 1e-6;

}  // namespace genu
