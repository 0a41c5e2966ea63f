// Every tolerance of the room `surface`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

namespace genu {

// analytic_ellipsoid

/// [1] Newton steps of a projection onto an ellipsoid. Fails first: if too small, projections onto flat ellipsoids
/// fail.
inline constexpr int kMaxEllipsoidSteps = 60;

/// [1] Error of |q| - 1 before the last step, which squares it. Fails first: if too large, projections lose digits.
inline constexpr double kEllipsoidTolerance = 1e-9;

// analytic_placed

/// [radius] Distance from a centre or axis below which the closest point is not unique: fewer than six digits. Fails
/// first: if too small, normals of round-off.
inline constexpr double kAmbiguousShare = 1e-10;

// blend_field

/// [1] Sum of weights at the end of the band (3 on the sheet, half of it on its edge). Fails first: if too small, the
/// surface runs past its data.
inline constexpr double kMinBlendWeight = 0.02;

/// [1] Weight of distance along a node's plane when a sheet is chosen. Fails first: if too large, the other face of a
/// thin shell is chosen.
inline constexpr double kSidewaysWeight = 0.1;

// blend_nodes

/// [1] Cosine of normals above which nodes thin each other out. Fails first: if too large, too many nodes on curved
/// parts.
inline constexpr double kFacesAlike = 0.3;

/// [1] Cosine of normals below which nodes never share a sheet. Fails first: if too large, edges are torn apart; if too
/// small, both faces of a shell are one.
inline constexpr double kFacesAway = -0.2;

/// [spacing] Distance from the nodes of a face, out of their 2.8, beyond which a crease has nodes of its own. Fails
/// first: if too large, gaps along creases; if too small, creases are rounded more than they need be.
inline constexpr double kCreaseReach = 2;

/// [1] A fit is repeated only for a radius narrower by this. Fails first: if too small, fits too wide for their
/// curvature.
inline constexpr double kWorthwhileRadius = 0.95;

/// [1] Equal distances are equal in every frame. Fails first: if equal to 1, results depend on the frame.
inline constexpr double kTieFactor = 1 - 1e-9;

/// [fit radius] How far from its origin a fit gives heights. Fails first: if too large, fits are used beyond their
/// samples.
inline constexpr double kFitReach = 0.7;

/// [fit radius] Radius of the blend. Fails first: if too small, gaps between nodes.
inline constexpr double kBlendRadius = kFitReach;

/// [fit radius] Distance of nodes. Fails first: if too large, gaps between nodes.
inline constexpr double kNodeSpacing = 0.25;

// front_distance

/// [1] Cells along each side of a patch in which a polynomial's slope is bounded. Fails first: if too small, slopes of
/// high degree are overstated and contacts are searched for nearby (time).
inline constexpr int kFrontCells = 8;

// local_fit

/// [1] Samples a coefficient needs. Fails first: if too small, fits swing between samples.
inline constexpr double kSamplesPerCoefficient = 1.6;

/// [1] Growth of a radius with too few samples. Fails first: if too large, fits too wide.
inline constexpr double kRadiusGrowth = 1.2;

/// [1] Largest growth. Fails first: if too small, no fit on coarse parts.
inline constexpr double kMaxRadiusGrowth = 2.6;

/// [1] Largest gain from residuals to heights (3 to 30 on knees, 3000 to 15000 where vertices stand in rows). Fails
/// first: if too large, fits of rows swing.
inline constexpr double kMaxLeverage = 50;

/// [1] Fit radius over the radius of curvature that truncates little. Fails first: if too large, tight curvature is
/// smoothed away.
inline constexpr double kMaxOfCurvature = 0.7;

// blend_surface

/// [blend radius] Distance of nodes that one point may see together. Fails first: if too small, a sheet is split.
inline constexpr double kNodeReach = 1.4;

/// [spacing] Distance of neighbouring nodes. Fails first: if too small, minima between nodes are missed.
inline constexpr double kLinkReach = 2;

/// [1] Newton steps of a projection onto the blend. Fails first: if too small, projections fail near edges.
inline constexpr int kMaxBlendSteps = 20;

/// [blend radius] Longest step. Fails first: if too large, a step jumps to another sheet.
inline constexpr double kLongestBlendStep = 0.5;

/// [blend radius] Step that leaves the derivatives as they are. Fails first: if too large, normals lose digits.
inline constexpr double kBlendSettled = 1e-11;

/// [blend radius] Step after which the next one converges. Fails first: if too large, normals lose digits.
inline constexpr double kBlendNearlySettled = 1e-3;

/// [blend radius] Distance from the surface up to which one Newton step comes near enough for a rough answer. Fails
/// first: if too large, descents are led astray; if too small, more evaluations.
inline constexpr double kBlendRoughly = 0.03;

/// [1] Least |grad f|, which is 1 on a true distance. Fails first: if too small, projections run away at edges.
inline constexpr double kMinBlendSlope = 0.3;

/// [blend radius] Step of a ray after which the next one converges. Fails first: if too large, depths lose digits.
inline constexpr double kBlendRayMet = 2e-6;

/// [blend radius] Distances to an edge are capped here. Fails first: if too small, contact near an edge is not
/// reported.
inline constexpr double kEdgeCap = 3;

// creases

/// [1] Share of a mesh's patches that are quiet. Fails first: if too large, a small solid is all rim.
inline constexpr double kQuietShare = 0.1;

/// [1] Heights off any polynomial, over those of quiet patches, of a crease (bones and cartilage 36 at most). Fails
/// first: if too small, roughness passes for creases.
inline constexpr double kLoudPatch = 40;

/// [1] Vertices of a part within creases that is a face. Fails first: if too small, scraps are fitted by themselves.
inline constexpr std::size_t kFewestOfFace = 20;

/// [1] Cosine of the angle (30 deg) by which a rough patch bends at a crease. Fails first: if too large, rough places
/// pass for creases.
inline constexpr double kCreasePatchBend = 0.866;

/// [1] Patches looked at first. Fails first: if too small, short creases are missed.
inline constexpr std::size_t kCreaseProbes = 400;

/// [1] Share of them that are loud from which a mesh has creases. Fails first: if too small, holes and spikes of a bone
/// count.
inline constexpr double kLoudShare = 0.02;

/// [rad] Bend of an edge (60 deg) that is a fold, whatever its patch: rows of vertices hide it from polynomials. Fails
/// first: if too small, coarse bones fold.
inline constexpr double kFold = 1.047;

/// [1] The same over the median bend. Fails first: if too small, rough meshes fold.
inline constexpr double kFoldOverMedian = 4;

/// [1] Share of vertices at folds from which a mesh has creases (bones 0.5 % at most). Fails first: as kLoudShare.
inline constexpr double kFoldedShare = 0.01;

/// [1] Rings round a fold that the narrowest patch reaches. Fails first: if too small, patches take in a fold.
inline constexpr int kNarrowestRings = 2;

/// [rad] Bend of an edge (25 deg) that fits stop at in a rough mesh with creases. Fails first: if too large, fits reach
/// over; if too small, fits stop on round parts.
inline constexpr double kSharpEdge = 0.436;

/// [1] The same over the usual bend, in a machined one. Fails first: as kSharpEdge.
inline constexpr double kUnusualBend = 2;

/// [rad] The smallest such bend (2 deg). Fails first: if too small, rounding of flat faces stops fits.
inline constexpr double kLeastSharpEdge = 0.035;

// fit_choice

/// [edge] Fit radius of a mesh without noise. Fails first: if too small, curvature of facets; if too large, curvature
/// is smoothed away.
inline constexpr double kRadiusWithoutNoise = 3;

/// [step] Fit radius of a staircase at least. Fails first: if too small, fits follow its steps.
inline constexpr double kRadiusOfSteps = 3;

/// [1] Ratio of the two radii at which disagreement is measured. Fails first: if too near to 1, noise is misjudged.
inline constexpr double kSecondRadius = 1.4;

/// [radius] Distance of two fits that are compared. Fails first: if too small, their errors are the same.
inline constexpr double kPartnerDistance = 0.7;

/// [1] Error of a fit over the median disagreement: white noise gives 28 sigma h / rho^3 for degree 3. Fails first: if
/// too small, radii too narrow for the noise.
inline constexpr double kDisagreementGain = 2.8;

/// [1] Error of curvature over the flat parts' mean curvature. Fails first: if too large, noisy curvature; if too
/// small, smoothed curvature.
inline constexpr double kToleratedError = 0.15;

/// [1] Quantile of the mean curvature (gives 5.5 mm to a femur and 7.4 mm to a tibia; 5 and 8 served best). Fails
/// first: if too large, radii too narrow for flat parts.
inline constexpr double kFlatQuantile = 0.1;

/// [1] Noise in curvature times fit radius that is none. Fails first: if too small, single precision widens fits.
inline constexpr double kNegligibleNoise = 1e-4;

/// [1] Places where disagreement is measured. Fails first: if too small, the radius depends on chance.
inline constexpr int kRadiusProbes = 200;

/// [1] Rounds of the radius' choice. Fails first: if too small, the radius is not settled.
inline constexpr int kRadiusRounds = 4;

/// [1] Relative change of the radius that ends them. Fails first: if too large, the radius is not settled.
inline constexpr double kRadiusSettled = 0.05;

// fit_uncertainty

/// [fit radius] Edge of the reference mesh of uncertainties. Fails first: nothing (a convention).
inline constexpr double kReferenceEdge = 0.2;

/// [spacing] Mean distance of nodes: greedy sampling leaves gaps up to 2. Fails first: nothing (a convention).
inline constexpr double kNodeDistance = 1.15;

// mesh_noise

/// [edge] Narrowest patch of the noise estimate. Fails first: if too small, facets pass for noise.
inline constexpr double kNarrowestPatch = 3;

/// [1] Rms of degree 2 over the radius: 0.9 radii of curvature. Fails first: if too large, shape passes for noise.
inline constexpr double kMaxPatchCurvature = 0.1;

/// [1] Radii of the estimate, each sqrt(2) as wide as the last. Fails first: if too small, long noise is missed.
inline constexpr int kMaxBands = 6;

/// [1] Fewest radii. Fails first: if too small, noise and shape are not told apart.
inline constexpr int kMinBands = 2;

/// [1] Patches a radius. Fails first: if too small, the estimate scatters.
inline constexpr int kNoiseProbes = 64;

/// [1] The same on a mesh with creases. Fails first: if too small, too few are whole.
inline constexpr int kCreasedNoiseProbes = 1000;

/// [1] Fewest patches a radius. Fails first: if too small, the estimate scatters.
inline constexpr int kMinProbes = 5;

/// [1] Lengths of shape, from the narrowest radius up by sqrt(2). Fails first: if too small, long shape passes for
/// noise.
inline constexpr int kShapeLengths = 18;

/// [1] Correlation lengths of noise, from an eighth of it up by 2^(1/4), and white. Fails first: if too small, long
/// noise is missed.
inline constexpr int kNoiseLengths = 24;

/// [radius] Shortest correlation length over the narrowest radius. Fails first: if too large, short noise is called
/// white.
inline constexpr double kShortestNoise = 1.0 / 8;

/// [1] Rounds of reweighted least squares. Fails first: if too small, outliers decide.
inline constexpr int kReweightings = 3;

/// [1] Misfit by which noise must improve. Fails first: if too small, shape passes for noise.
inline constexpr double kNoiseEvidence = 10;

/// [1] Difference of misfits that are alike. Fails first: nothing (choice of the shortest).
inline constexpr double kAlikeMisfit = 1;

/// [m^2] Guard of logarithms. Fails first: nothing.
inline constexpr double kTinyEnergy = 1e-300;

// patch_shells

/// [1] Samples of a patch; wider ones are thinned. Fails first: if too small, the estimate scatters.
inline constexpr int kMaxShellSamples = 56;

// polynomial_surface

/// [1] Steps of a projection onto a polynomial. Fails first: if too small, projections onto steep ones fail.
inline constexpr int kMaxProjectionSteps = 100;

/// [1] Step over the lengths met whose square is round-off of a distance. Fails first: if too large, projections lose
/// digits.
inline constexpr double kProjectionBasin = 1e-7;

/// [1] Next step over the lengths met that rounding hides. Fails first: if too large, projections lose digits.
inline constexpr double kProjectionRounding = 1e-17;

/// [1] Armijo's constant. Fails first: if too large, slow projections.
inline constexpr double kSufficientDecrease = 1e-4;

/// [1] Determinant over the metric's below which Newton's step is a leap. Fails first: if too small, projections run to
/// another sheet.
inline constexpr double kConvexShare = 1e-3;

// samples

/// [1] Cosine of normals on the same side of a thin sheet. Fails first: if too small, samples of the other side are
/// removed.
inline constexpr double kSameSideCosine = 0.3;

// surface

/// [1] Newton steps along a ray. Fails first: if too small, rays miss curved surfaces.
inline constexpr int kMaxRaySteps = 20;

/// [1] Cosine of a ray with the normal below which it grazes. Fails first: if too small, a ray runs away.
inline constexpr double kGrazingCosine = 1e-3;

/// [m] Step that leaves an error of its square times the curvature. Fails first: if too large, depths lose digits.
inline constexpr double kRaySettled = 1e-9;

// patch

/// [1] Halvings of the edge until a narrow patch holds a vertex. Fails first: if too small, narrow patches seem empty.
inline constexpr int kPatchHalvings = 8;

/// [1] Doublings of a box that limits a steep patch. Fails first: if too small, steep patches are cut short.
inline constexpr int kPatchDoublings = 4;

// tessellate

/// [1] Most triangles of a mesh cut from a formula; edges grow above it. Fails first: if too small, layers on formulas
/// are coarse.
inline constexpr double kMaxTriangles = 200'000;

// tessellate_refine

/// [edge] Length over the wanted one above which an edge is split. Fails first: if too small, halves are shorter than
/// wanted.
inline constexpr double kSplitRatio = 4.0 / 3;

/// [1] Passes of refinement, each halves the longest edges. Fails first: if too small, long edges stay.
inline constexpr int kMaxRefinePasses = 60;

/// [1] Passes that even out triangles. Fails first: if too small, slivers.
inline constexpr int kRelaxations = 10;

}  // namespace genu
