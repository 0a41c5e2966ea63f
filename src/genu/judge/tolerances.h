// Every tolerance of the room `judge`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

#include <cstddef>

namespace genu::judge {

// balance

/// [1] Unbalanced force over the sum of all forces' sizes. Fails first: if too small, solved poses are rejected; if too
/// large, a wrong force passes.
inline constexpr double kBalanceTolerance = 1e-9;

/// [1] Round-off of moments over forces times levers. Fails first: if too small, models far from their origin are
/// rejected.
inline constexpr double kLeverRounding = 3e-12;

/// [1] Damping from which directions of contact forces are sought. Fails first: if too small, the search begins with
/// leaps.
inline constexpr double kStiffestHold = 1e6;

/// [1] Damping at which the search ends. Fails first: if too large, cones of facets are not used up.
inline constexpr double kSoftestHold = 1e-4;

/// [1] Further rounds at the softest damping. Fails first: if too small, balanced poses are rejected.
inline constexpr int kMaxConeRounds = 30;

/// [deg] Least opening of a cone of facets' normals. Fails first: if too small, round-off of a normal rejects a pose.
inline constexpr double kMinCone = 1e-6;

// clearance

/// [1] Cells across a set of boxes. Fails first: if too small, nothing is seen to be clear; if too large, memory.
inline constexpr double kClearanceCells = 64;

// curve

/// [s] Step of the difference that is the rate of a target. Fails first: if too large, rates of fast targets are
/// inexact; if too small, they are round-off.
inline constexpr double kCourseStep = 1e-4;

/// [1] Error of a scale with such a rate, over 1 + its size. Fails first: if too small, right scales are rejected.
inline constexpr double kFeedbackRateTolerance = 1e-5;

// facets

/// [1] Most cells across a mesh. Fails first: if too small, cells hold many triangles; if too large, memory.
inline constexpr double kMostCellsAcross = 256;

/// [cell] Triangles count this far beyond their cells. Fails first: if too small, a ray along the border of cells
/// passes between triangles.
inline constexpr double kCellMargin = 1e-6;

/// [edge] How deep overlap is looked for. Fails first: if too small, deep overlap is missed.
inline constexpr double kOverlapReach = 2;

/// [edge] Facets this near bound the smooth surface's normal. Fails first: if too small, fitted surfaces are rejected.
inline constexpr double kLeanReach = 3;

// gaps

/// [1] Lowest samples of a pair that are followed. Fails first: if too small, the smallest gap is missed.
inline constexpr std::size_t kDescents = 5;

/// [size] Distance of the points that show whether a surface ends. Fails first: if too small, round-off decides.
inline constexpr double kBesideShare = 1e-5;

/// [1] 1 + cosine of normals that oppose each other (0.1 deg). Fails first: if too small, minima at edges pass for
/// contacts.
inline constexpr double kOpposedRounding = 1e-6;

/// [m] How far certified gaps may lie below 0 in results.csv. Fails first: if too small, written digits reject a pose.
inline constexpr double kWrittenGap = 1e-8;

/// [size] Overhang at a rim that samples may pass. Fails first: if too small, poses near a rim are rejected.
inline constexpr double kRimPassed = 1e-3;

// joints

/// [rad] Step of the eighth-order difference: error (0.02)^8 / 630. Fails first: if too large, the judge's Jacobian is
/// inexact.
inline constexpr double kDifferenceTurn = 0.02;

// layers

/// [thickness] Compression above which the logarithmic law is its tangent (docs/scene-reference.md). Fails first: if
/// differs from the solver, deep layers are rejected.
inline constexpr double kTangentFrom = 0.95;

/// [edge] Vertices this near count for the quadric at a vertex. Fails first: if too small, noise bends facets; if too
/// large, quadrics miss the surface.
inline constexpr double kQuadricReach = 2.2;

/// [edge] The same of quadrics that show what another fit could make of noise. Fails first: if too small, fits of noisy
/// meshes are rejected; if too large, shapes count as noise.
inline constexpr double kWideQuadricReach = 6;

/// [fit radius] The same where a fit radius is given. Fails first: if too small, the doubt of a fit vanishes.
inline constexpr double kWiderFit = 1.5;

/// [1] Cosine between the normals of a triangle and of its corner (35 deg) below which the corner is on a crease. Fails
/// first: if too small, creases are rounded; if too large, coarse round shapes are not.
inline constexpr double kCreaseCosine = 0.82;

/// [1] Vertices that a quadric is fitted to at least. Fails first: if too small, fits at the rim are wild.
inline constexpr std::size_t kEnoughForQuadric = 10;

/// [edge] Distance of bent facets from triangles up to which a ray begins inside of them. Fails first: if too large,
/// it begins behind another part of the body.
inline constexpr double kMostBend = 0.15;

/// [1] Cosine between a ray and a normal below which it does not meet the surface. Fails first: if too small, depths at
/// grazing rays are wild.
inline constexpr double kGrazingRay = 0.2;

/// [load] Tolerance of a layer's force from which a comparison says nothing. Fails first: if too large, wrong tables
/// pass as judged.
inline constexpr double kSaysLittle = 0.5;

/// [1] Samples in contact that a sum needs. Fails first: if too small, sums scatter.
inline constexpr double kEnoughSamples = 1000;

/// [1] Finest refinement for it. Fails first: if too small, small contacts are judged by few samples.
inline constexpr int kFinestSampling = 4;

/// [1] Samples in contact that the sum of a raised layer needs, which is part of a tolerance. Fails first: if too
/// small, tolerances scatter.
inline constexpr double kRaisedSamples = 100;

/// [edge] How far a layer is raised to find where contact would begin. Fails first: if too small, no place is found.
inline constexpr double kNearlyTouching = 0.25;

/// [1] Samples at the border of contact: a sum of n may be off by this / n. Fails first: if too small, small contacts
/// are rejected.
inline constexpr double kBorderSamples = 3;

/// [thickness] Depth that samples may miss, over 100 + n. Fails first: if too small, grazing contacts are rejected.
inline constexpr double kMissedDepth = 0.1;

/// [force scale] Load below which a layer's tolerance is absolute. Fails first: if too small, grazing contacts are
/// rejected.
inline constexpr double kMinLoadShare = 0.01;

/// [disc radius] Distance along a ray from the mesh within which its border counts (docs/scene-reference.md). Fails
/// first: it is part of a definition, and triangle layers are rejected.
inline constexpr double kBorderDepth = 4;

/// [disc radius] Distance at which a ray passes through the border, and its side is rounding. Fails first: if too
/// small, a ray through the border is taken for one on its other side.
inline constexpr double kThroughBorder = 1e-9;

/// [1] Least share of a disc that carries load. Fails first: if too small, rounding counts as a triangle that carries.
inline constexpr double kLeastDiscShare = 1e-9;

/// [1] Error of facets for a smooth surface's load. Fails first: if too small, smooth layers are rejected.
inline constexpr double kFacetLoadError = 0.05;

/// [size of the scene] Distance of a triangle's centre from the border of a region at which its side is rounding. Fails
/// first: if too small, the same sum is rejected.
inline constexpr double kRegionBorder = 1e-12;

// motion

/// [1] Rows on each side of a time difference. Fails first: if too small, motions cannot be judged.
inline constexpr std::size_t kDifferenceRows = 4;

/// [1] Error of a rate, over the largest, up to which a row is judged. Fails first: if too large, wrong rates are
/// judged as right.
inline constexpr double kResolvedRate = 1e-3;

// pose

/// [1] Relative rounding of numbers that follow by a formula. Fails first: if too small, written digits are rejected.
inline constexpr double kFormulaRounding = 1e-12;

/// [1] Largest residual of a row called solved (docs/scene-reference.md, Solver). Fails first: if too small, good rows
/// are rejected.
inline constexpr double kMaxSlack = 1e-8;

/// [1] Ratio of the judge's norm of a residual to the solver's. Fails first: if too small, good rows are rejected.
inline constexpr double kResidualNorms = 30;

// shape

/// [1] How much steeper a polynomial is at most a few samples further on. Fails first: if too small, samples in contact
/// are left out and sums are too small.
inline constexpr double kSteeperNearby = 4;

// start_sides

/// [1] Vertices of a mesh whose side is looked at. Fails first: if too small, a pair is not recognised; if too large,
/// the check takes long.
inline constexpr std::size_t kSideVertices = 300;

/// [1] Fewest vertices over the other mesh that tell how a pair lies. Fails first: if too small, chance decides.
inline constexpr std::size_t kFewestOver = 20;

/// [1] Height in front, over the largest depth behind, at which surfaces that touch lie back to back. Fails first: if
/// too small, those that touch at the start are not recognised.
inline constexpr double kStillBehind = 1e-3;

/// [1] Mean distance in the middle third over that in the outer third below which a gap widens. Fails first: if too
/// large, surfaces that overlap at the start are taken for inside out.
inline constexpr double kGapWidens = 0.9;

// subject

/// [stiffness] Force of a strain that round-off makes. Fails first: if too small, slack ligaments are rejected.
inline constexpr double kStrainRounding = 1e-12;

// results_file

/// [1] Errors of results.csv that are listed. Fails first: if too large, a garbage file fills the terminal.
inline constexpr std::size_t kMaxFileErrors = 20;

// wrapping

/// [edge] How far from a mesh its facets are looked for. Fails first: if too small, chains leave the mesh.
inline constexpr double kSkinReach = 3;

/// [1] Links of the coarser of two chains over an arc. Fails first: if too small, lengths of arcs are unsure.
inline constexpr int kChainLinks = 48;

/// [1] Rounds in which a chain is shortened, for each link. Fails first: if too small, good arcs are rejected.
inline constexpr int kShorteningRounds = 40;

/// [arc] Move of a point in one round at which a chain is settled. Fails first: if too large, good arcs are rejected.
inline constexpr double kChainSettled = 1e-13;

/// [1] Error of an extrapolated length over the difference of two chains. Fails first: if too small, good arcs are
/// rejected; if too large, wrong ones pass.
inline constexpr double kChainError = 0.02;

/// [rad] Angle of a leg with the tangent plane where it touches. Fails first: if too small, solved paths are rejected.
inline constexpr double kLegTangent = 1e-7;

/// [rad] Angle of a leg with the chain that it continues. Fails first: if too small, coarse chains reject good paths;
/// if too large, a path with a corner passes.
inline constexpr double kLegCorner = 2e-3;

/// [size] Arcs shorter than this have no course of their own. Fails first: if too small, round-off is judged.
inline constexpr double kShortestCourse = 1e-4;

}  // namespace genu::judge
