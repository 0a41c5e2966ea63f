// Every tolerance of the room `assemble`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

#include <cstdint>

namespace genu {

// build_surface

/// [m] Edge of the mesh that shows whether a patch holds any surface, and its size. Fails first: if too large, a small
/// patch seems empty.
inline constexpr double kPatchProbeEdge = 0.01;

/// [m] How far that mesh reaches. Fails first: if too small, a patch far out seems empty.
inline constexpr double kPatchProbeReach = 0.1;

// given_poses

/// [1] Largest number of a step or increment in a table of poses. Fails first: if too large, an int overflows.
inline constexpr double kMaxStepNumber = 1e9;

/// [rad] Difference of a transform from what its joint holds that is rounding. Fails first: if too small, tables of few
/// digits get a warning.
inline constexpr double kHeldAngle = 2e-3;

/// [m] The same of translations. Fails first: if too small, tables of few digits get a warning.
inline constexpr double kHeldLength = 1e-5;

/// [m] Translation above which a column that nobody gives a unit is probably in mm. Fails first: if too small, a walk
/// across a laboratory gets a warning.
inline constexpr double kMostTranslation = 2;

// facing

/// [1] Most triangles whose lines decide which way surfaces face. Fails first: if too small, a stray line decides.
inline constexpr std::size_t kMaxFacingLines = 1000;

/// [1] Fewest lines that decide. Fails first: if too small, a stray line decides.
inline constexpr std::size_t kMinFacingLines = 20;

/// [1] Share of the nearest lines that must agree. Fails first: if too small, false warnings.
inline constexpr double kFacingShare = 0.75;

/// [1] Distance in the middle over that at the edge below which a gap widens. Fails first: if too large, a flat overlap
/// is called a gap between backs.
inline constexpr double kWideningShare = 0.9;

/// [1] Triangles along a closed form that stand for it. Fails first: if too small, its curvature is lost.
inline constexpr double kFacingTriangles = 60;

// pose_file

/// [B] Largest file of poses. Fails first: if too large, out of memory instead of a refusal.
inline constexpr std::uintmax_t kMaxPoseFileBytes = std::uintmax_t{1} << 30;

// read_solids

/// [1] Volume over that of the box of the same area below which a solid is flat (a needle 1000 times as long as thick
/// has 0.05). Fails first: if too large, thin solids are refused.
inline constexpr double kMinFullness = 1e-4;

// rigid_transform

/// [1] Error of R R^T that is rounding (three decimals leave 1e-3). Fails first: if too small, tables of few digits are
/// refused.
inline constexpr double kRotationRounding = 2e-3;

// surface_fits

/// [noise] Rms residual of a fit that measured cartilage leaves at most (1 to 3 seen). Fails first: if too small, good
/// fits get a warning.
inline constexpr double kFitRmsOfNoise = 4;

/// [m] Rms residual that no scan resolves. Fails first: if too small, good fits get a warning.
inline constexpr double kFitRmsUnseen = 1e-4;

/// [noise or rms] Largest residual that random noise leaves. Fails first: if too small, good fits get a warning.
inline constexpr double kFitPeakOfNoise = 8;

/// [m] Largest residual that no scan resolves. Fails first: if too small, good fits get a warning.
inline constexpr double kFitPeakUnseen = 5e-4;

// unlikely_lengths

/// [1] Length of a ligament over the size of the meshes (0.1 to 5 in knees) that is probably a mistake. Fails first:
/// if too small, a muscle beside a patella (10) gets a warning.
inline constexpr double kMostLengthRatio = 15;

/// [1] The least. Fails first: if too large, a capsule's short bundle gets a warning.
inline constexpr double kLeastLengthRatio = 4e-3;

/// [1] How much wider both limits are beside closed forms, which may be the part of a surface that touches, or a dish
/// much larger than it. Fails first: if too small, a ball of 1 mm that stands for a groove gets a warning.
inline constexpr double kShapesWider = 6;

/// [1] Lengths of a scene over the size of its meshes, or the inverse, that show another unit. Fails first: if too
/// small, meshes far from the origin of their body get a warning.
inline constexpr double kOtherUnitRatio = 100;

}  // namespace genu
