// Every tolerance of the room `shape_fit`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

#include <cstddef>
#include <numbers>

namespace genu {

// chart_choice

/// [1] Cosine with the mean normal (60 deg) beyond which area is outside of the cone. Fails first: if too large, flat
/// charts are refused.
inline constexpr double kConeMinCosine = 0.5;

/// [1] Area outside of the cone that calls for a round chart. Fails first: if too small, flat charts are refused.
inline constexpr double kOutsideConeShare = 0.05;

// chart_mesh

/// [edge] Cell of a chart's mesh: sides of 0.88 and diagonals of 1.24 make one edge in the mean. Fails first: nothing
/// (mean edge only).
inline constexpr double kChartCell = 0.88;

/// [1] Most triangles of a chart's mesh. Fails first: if too large, out of memory.
inline constexpr double kMaxChartTriangles = 1e6;

// covered_box

/// [1] Cost of a bare spot over the gain of a covered one. Fails first: if too small, patches reach over holes.
inline constexpr double kBareSpotCost = 6;

// fit_zone

/// [1] Cosine with --facing (70 deg). Fails first: if too small, the far side of a bone is fitted.
inline constexpr double kFacingCosine = 0.342;

/// [1] Area of a sheet below which it is a crumb. Fails first: if too small, crumbs become surfaces.
inline constexpr double kSheetShare = 0.1;

/// [1] Least length of an arm (8 of 5 deg). Fails first: if too small, notches make arms.
inline constexpr int kMinArmSectors = 8;

/// [1] Gap along the axis, over the sheet's extent, that parts arms. Fails first: if too small, holes make arms.
inline constexpr double kNotchWidth = 0.08;

/// [1] Area of an arm over the sheet's. Fails first: if too small, slivers make arms.
inline constexpr double kArmShare = 0.2;

// patch_border

/// [1] Points of a patch's side, corners included. Fails first: if too small, a side of noise.
inline constexpr std::size_t kMinSidePoints = 4;

/// [rad] Turn at a corner of a border. Fails first: if too small, bends of a side are corners.
inline constexpr double kCornerTurn = 0.5;

/// [1] Depth of a side over its scatter that determines its plane. Fails first: if too small, tilted frames.
inline constexpr double kPlaneDepthRatio = 1e4;

/// [m] Least depth. Fails first: if too small, planes of round-off.
inline constexpr double kMinSideDepth = 1e-6;

/// [rad^2] Squared angle that lines must spread over to meet in a point. Fails first: if too small, axes of round-off.
inline constexpr double kMinSpread = 1e-4;

/// [step] Distance from a round number that counts as one. Fails first: if too small, file rounding moves a patch.
inline constexpr double kRoundedStep = 1e-4;

/// [m] Half sides of patches are multiples of this. Fails first: nothing (a convention).
inline constexpr double kRoundLength = 1e-4;

/// [rad] The same round an axis (0.5 deg). Fails first: nothing (a convention).
inline constexpr double kRoundAngle = std::numbers::pi / 360;

// polynomial_fit

/// [1] Part of a column that the ones before leave. Fails first: if too small, coefficients of round-off.
inline constexpr double kIndependentColumn = 1e-7;

/// [1] Folds of the cross-validation. Fails first: if too small, the degree depends on chance.
inline constexpr int kFolds = 10;

/// [m] Height of a term that nowhere shows. Fails first: if too small, files hold terms of round-off.
inline constexpr double kNoTerm = 1e-16;

/// [1] Residual over that of the highest degree that is the same. Fails first: if too small, a known polynomial gets a
/// higher degree.
inline constexpr double kSameResidual = 2;

/// [m] Residual of coordinates of some cm that is round-off. Fails first: if too small, a known polynomial gets a
/// higher degree.
inline constexpr double kFitRounding = 1e-15;

/// [1] Score over the best that is as good. Fails first: if too small, higher degrees; if too large, lower ones.
inline constexpr double kAsGoodScore = 1.05;

/// [1] Samples a coefficient needs. Fails first: if too small, polynomials swing.
inline constexpr int kSamplesForEach = 3;

// solid_field

/// [1] Newton steps onto a solid's surface. Fails first: if too small, vertices lie off the surface.
inline constexpr int kMaxFieldSteps = 60;

/// [m] Distance at which they end. Fails first: if too large, vertices lie off the surface.
inline constexpr double kFieldArrived = 1e-12;

// solid_mesh

/// [1] Most points of a solid's grid. Fails first: if too large, out of memory.
inline constexpr double kMaxGridNodes = 3e7;

/// [edge] Distance of a vertex from the ends of its grid edge. Fails first: if too small, slivers.
inline constexpr double kFromEnds = 0.1;

/// [1] Triangles below which a solid is coarse: a ball loses a tenth of its volume. Fails first: if too small, coarse
/// solids pass.
inline constexpr std::size_t kMinSolidTriangles = 100;

/// [edge] Edge of the first mesh, coarser than asked for, for refinement to split. Fails first: if too small, edges
/// shorter than asked for.
inline constexpr double kSolidStretch = 1.25;

// surface_fit

/// [1] Cosine of a facet over its chart (65 deg); steeper ones are left out. Fails first: if too small, heights are
/// double-valued.
inline constexpr double kMinFacetCosine = 0.4226;

/// [m] Block of the cross-validation: noise of a segmentation is alike over less. Fails first: if too small, noise is
/// fitted.
inline constexpr double kValidationBlock = 0.005;

/// [1] Lowest degree that is chosen. Fails first: nothing (a choice).
inline constexpr int kLowestChosen = 2;

/// [1] Highest degree that is chosen. Fails first: if too large, polynomials swing at edges.
inline constexpr int kHighestChosen = 10;

/// [1] Degree of the first frames. Fails first: if too large, frames follow noise.
inline constexpr int kFrameDegree = 6;

/// [patch] How far samples go past a patch's edges. Fails first: if too small, polynomials swing at edges.
inline constexpr double kSampledBeyond = 0.05;

/// [m] Rounding of a mesh file (float32 at 30 mm). Fails first: if too small, rounding raises the degree.
inline constexpr double kFileRounding = 2e-9;

/// [m] Margin round points to keep, where a patch may be bare. Fails first: if too small, contacts run over the edge.
inline constexpr double kKeptBeyond = 0.003;

/// [m] Residual below which charts are equal and area decides. Fails first: if too large, poor charts.
inline constexpr double kGoodEnoughRms = 2e-5;

/// [1] Other side of a patch over the longer one. Fails first: if equal to 1, the frame's axes are arbitrary.
inline constexpr double kLongerSide = 0.95;

/// [1] Rounds that settle a frame. Fails first: if too small, frames depend on the start.
inline constexpr int kMaxFrameRounds = 60;

/// [1] Rounds before slow progress ends them. Fails first: if too small, frames depend on the start.
inline constexpr int kPatientRounds = 8;

/// [1] Ratio of changes that is progress. Fails first: if too small, frames depend on the start.
inline constexpr double kStillFalls = 0.8;

/// [rad] Change that ends the rounds. Fails first: if too small, round-off never settles.
inline constexpr double kFrameSettled = 1e-13;

/// [rad] Change that is accepted at the end. Fails first: if too large, frames depend on the start.
inline constexpr double kFrameNearlySettled = 1e-7;

/// [step] Distance from a round number that counts as one. Fails first: if too small, a round side shrinks by a step.
inline constexpr double kRoundNumber = 1e-3;

/// [1] Cosine of faces that look opposite ways. Fails first: if too large, steep faces count as a second cover.
inline constexpr double kOpposedCosine = -0.3;

/// [1] Area of them that refuses a chart. Fails first: if too small, good charts are refused.
inline constexpr double kOpposedShare = 0.1;

// tame_degree

/// [1] Points each way at which a polynomial is looked at. Fails first: if too small, a swing is missed.
inline constexpr int kLooksAcross = 40;

/// [1] Cosine of the steepest slope (72 deg). Fails first: if too small, polynomials like walls pass.
inline constexpr double kMinSlopeCosine = 0.309;

/// [radius] Least radius of a round chart over the middle one. Fails first: if too small, the surface meets its axis.
inline constexpr double kMinRadiusShare = 0.2;

/// [1] Swing between samples over that on them. Fails first: if too large, a swing passes.
inline constexpr double kSwingFactor = 2;

/// [m] Swing that is always allowed. Fails first: if too small, degrees are lowered for nothing.
inline constexpr double kSwingAllowed = 1e-4;

// thicken

/// [1] Most triangles of walls. Fails first: if too large, out of memory.
inline constexpr double kMaxWallTriangles = 4e6;

}  // namespace genu
