// Every tolerance of the room `contact`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

#include <array>
#include <cstddef>

namespace genu {

// buried

/// [1] Rays that sample whether one surface lies inside the other. Fails first: if too small, a buried start is not
/// seen.
inline constexpr std::size_t kMaxBuriedRays = 120;

// contact_equations

/// [1] One-norm of I - A A^-1 above which an inverse is none. Fails first: if too large, contacts that conform in two
/// directions divide by round-off.
inline constexpr double kMaxMissingInverse = 0.5;

/// [1] Reciprocal condition of a contact's own equations below which they are not eliminated. Fails first: if too
/// small, the eliminated step keeps under half of the digits.
inline constexpr double kSingularContact = 1e-8;

// far_distance

/// [turn] Winding number from which a point is inside, between pieces. Fails first: if too large, points between
/// overlapping pieces are outside.
inline constexpr double kInsideWinding = 0.5;

/// [turn] The same behind the edge of an open sheet (at most 1/4 behind a flat one). Fails first: if too large, points
/// behind an edge have a positive gap.
inline constexpr double kBehindEdgeWinding = 0.2;

/// [1] Places on a sheet where its winding number is looked at. Fails first: if too small, its range is
/// underestimated.
inline constexpr std::size_t kWindingsAtSheet = 100;

/// [edge] How far from the sheet, on either side. Fails first: if too small, round-off tells the side; if too large, it
/// is not the limit.
inline constexpr double kBesideSheet = 1e-3;

/// [1] What the range of a winding number over these places is multiplied by (that of cartilage is up to 7 % too
/// small). Fails first: if too small, a change of side is missed; if too large, sides are looked at often (time).
inline constexpr double kWindingReserve = 1.15;

/// [1] Points on the edge of a sheet, across it, to which its distance is bounded. Fails first: if too large, each look
/// takes longer (time); if too small, sides are looked at often (time).
inline constexpr double kEdgePointsAcross = 40;

/// [1] Halvings that find how far a point may go. Fails first: if too small, sides are looked at often (time).
inline constexpr int kSameSideHalvings = 10;

/// [1] Sine of the angle between the normal of an edge of a sheet and those of the faces beside it. Fails first: if too
/// small, a change of side is missed.
inline constexpr double kEdgeTurn = 0.2;

/// [turn] Largest error of a winding number (test WindingNumber.FastIsExact). Fails first: if too small, a change of
/// side is missed.
inline constexpr double kWindingError = 0.04;

/// [1] Pieces whose boxes are compared; more count as entangled. Fails first: if too small, winding numbers for nothing
/// (time).
inline constexpr int kMaxPiecesCompared = 64;

// feature_normals

/// [1] Barycentric coordinate below which a nearest point lies on an edge or vertex. Fails first: if
/// too small, the sign of a distance comes from one facet.
inline constexpr double kOnFeature = 1e-7;

// hertz

/// [1] Most steps of the means in Hertz' integrals; each doubles the digits. Fails first: if too small, Hertz' check is
/// wrong for long ellipses.
inline constexpr int kMaxMeanSteps = 200;

/// [1] Relative spread of the arguments at which Carlson's series of sixth order is exact. Fails first: if too large,
/// Hertz' check loses digits.
inline constexpr double kCarlsonSpread = 2e-3;

// layer_law

/// [thickness] Compression above which the logarithmic law continues along its tangent. Fails first: if too small, deep
/// layers are too soft; if too large, Newton meets infinity.
inline constexpr double kMaxCompression = 0.95;

// layer_rays

/// [edge] Clearances of groups of rays that are tried, from the largest. Fails first: if too small, rays are looked at
/// often (time).
inline constexpr std::array kClearances = {8.0, 2.0, 0.5, 0.1, 0.02};

/// [edge] Motion after which a group near the surface is looked at again. Fails first: if too large, contact begins
/// unseen.
inline constexpr double kRecheckMotion = 4;

/// [edge] Motion for which triangles near a group are gathered. Fails first: if too small, they are gathered often
/// (time).
inline constexpr double kPocketMotion = 3;

/// [edge] Motion for which the triangles of a ray are listed. Fails first: if too small, lists are renewed often
/// (time).
inline constexpr double kMinListedMotion = 0.05;

/// [edge] Length beyond its hit within which a ray is known to enter nothing. Fails first: if too small, it is asked
/// again as the hit moves (time).
inline constexpr double kUnenteredLength = 1;

/// [edge] Motion after which a ray that passes near triangles it could enter is asked again whether it is clear of
/// them. Fails first: if too small, it is asked in vain (time).
inline constexpr double kRetryUnentered = 1;

/// [1] Relative margin of a group's sphere. Fails first: if too small, a ray at its rim is lost.
inline constexpr double kMarginRounding = 1e-6;

// local_minimum

/// [1/m] Negative curvature of the gap up to which a stationary point is a minimum: over 1 mm it falls by 1e-9 m. Fails
/// first: if too small, valleys have no minimum; if too large, saddles are contacts.
inline constexpr double kSaddleCurvature = 2e-3;

/// [radius] Relative error of a step's length on the trust region. Fails first: if too small, more inner iterations; if
/// too large, slow descent.
inline constexpr double kTrustLengthTolerance = 1e-3;

/// [1] Newton steps to the foot of a point on a smooth surface. Fails first: if too small, feet near focal points are
/// inexact.
inline constexpr int kMaxFootSteps = 12;

/// [longest step] Step from which a descent looks to rounding and no longer roughly. Fails first: if too small, rough
/// gaps hide their decrease; if too large, more evaluations.
inline constexpr double kRoughWay = 0.01;

/// [step] Distance of a rough foot from the closest point. Fails first: if too large, descents are led astray; if too
/// small, more evaluations.
inline constexpr double kRoughFoot = 0.01;

/// [radius of curvature] Distance from a foot up to which it is followed as the point moves, and not looked for anew.
/// Fails first: if too large, another foot is nearer; if too small, more evaluations.
inline constexpr double kSteadyFoot = 0.25;

/// [1] Most steps of a descent of the gap. Fails first: if too small, long valleys yield no minimum.
inline constexpr int kMaxDescentSteps = 60;

/// [1] Gradient of the gap (a sine) at which normals are parallel to round-off. Fails first: if too small, descents
/// never end; if too large, minima are inexact.
inline constexpr double kFlatGradient = 1e-13;

/// [m] Step below which the point no longer changes. Fails first: if too small, descents never end.
inline constexpr double kShortestDescent = 1e-14;

// proximity

/// [spacing] Two refined minima nearer than this are one. Fails first: if too small, one contact is listed twice, and
/// the equations are singular.
inline constexpr double kSamePoint = 2e-3;

/// [spacing] Gap below which a sample may have a closed contact beside it: 0.2/2 x 1.2^2. Fails first: if too small, a
/// contact between samples is missed.
inline constexpr double kNearContact = 0.15;

/// [spacing] Gap of a start's model above which it is not followed. Fails first: if too small, minima between samples
/// are missed.
inline constexpr double kHopelessGap = 0.03;

/// [spacing] How far a start that is not the lowest of its neighbours is followed. Fails first: if too small, twins are
/// missed; if too large, conforming surfaces take long.
inline constexpr double kBetweenSamples = 4;

/// [spacing] A descent that comes this near to a known minimum ends there. Fails first: if too large, close twins are
/// missed.
inline constexpr double kMergeDistance = 0.1;

/// [spacing] Deviation of facets from the smooth surface. Fails first: if too small, facets are called overlapping.
inline constexpr double kShallowOverlap = 0.05;

/// [1] Cosine of outward normals (60 deg) above which sides cannot touch. Fails first: if too small, contacts of steep
/// sides are dropped.
inline constexpr double kSameWayCosine = 0.5;

/// [spacing^2] Area of a sample below which samples are thinned. Fails first: if too large, contact search is slow.
inline constexpr double kDenseSamples = 0.5;

/// [1] Share of a gap in the band of a mesh that is surely clear: the gap is a distance to first order. Fails first: if
/// too large, contact is missed near edges.
inline constexpr double kFirstOrderGap = 2.0 / 3;

/// [motion] Motion toward the other body that still counts as clear. Fails first: if too small, groups are looked at
/// often (time).
inline constexpr double kClearanceUse = 0.25;

/// [spacing] How far behind a sample the other surface is looked for. Fails first: if too small, thin sheets are not
/// seen.
inline constexpr double kBehindSample = 0.5;

/// [spacing] Depth from which a sample is swallowed by the other body. Fails first: if too small, shallow overlap
/// counts as swallowed.
inline constexpr double kSwallowedDepth = 0.25;

/// [spacing] Nearest samples that show a gap's rise beside a minimum. Fails first: if too small, round-off decides.
inline constexpr double kFlankNear = 0.5;

/// [spacing] Farthest ones. Fails first: if too large, other minima decide.
inline constexpr double kFlankFar = 3;

/// [spacing] Distance from a known minimum within which a descent may be in its bowl. Fails first: if too large, other
/// minima lie between.
inline constexpr double kBowlFar = 6;

/// [way, rise] Deviation from a cubic up to which the gap is that of a known minimum's bowl. Fails first: if too
/// large, a second minimum is missed.
inline constexpr double kBowlShare = 0.05;

/// [rise] Deviation from the expected rise at which a sample belongs to the same minimum. Fails first: if too large, a
/// second minimum is missed.
inline constexpr double kFlankShare = 0.05;

/// [1] Most minima of a pair; more of them conform. Fails first: if too small, contacts are missed; if too large, time.
inline constexpr std::size_t kMaxMinima = 500;

// rim

/// [chord] Distance of a border's vertex from the edge that is round-off. Fails first: if too small, a rim is not
/// recognised.
inline constexpr double kOnRim = 1e-3;

/// [spacing] Length of a segment of a rim. Fails first: if too large, two low places on one segment.
inline constexpr double kRimChord = 4;

/// [chord] Deepest sag of a rim between two points. Fails first: if too small, contact at a rim is missed.
inline constexpr double kRimDip = 0.2;

/// [1] How far inside a rim's lowest point the gap is compared, toward the triangle's middle. Fails first: if too
/// small, round-off decides whether contact leaves the surface.
inline constexpr double kRimInward = 0.02;

/// [its length] Gap over a piece of a rim above which it is not searched further: a gap falls by no more than the
/// length that it is passed along. Fails first: if too small, overlap at a rim is missed.
inline constexpr double kRimClear = 1;

/// [1] Golden sections of a rim's segment (to 1e-5 of it). Fails first: if too small, the lowest place is inexact.
inline constexpr int kRimSections = 24;

// curved_facets

/// [1] Last step of a line's meeting with a facet, in its parameters; the error left is its square. Fails first: if too
/// large, depths are rough and Newton's method stalls.
inline constexpr double kFacetStep = 1e-7;

/// [1] Distance beyond a side, in barycentric coordinates, at which the next facet is tried at once. Fails first: if
/// too small, a line that comes back is sent away.
inline constexpr double kFacetLeave = 0.5;

/// [1] Distance beyond a side from which the line meets the next facet. Fails first: if too small, a line on an edge
/// goes to and fro.
inline constexpr double kFacetEdge = 1e-9;

/// [1] Distance up to which a facet counts beyond the rim of the surface. Fails first: if too small, lines that meet
/// the rim's triangles miss the facets.
inline constexpr double kFacetOver = 0.3;

/// [1] Most steps on a facet. Fails first: if too small, lines fall back to flat triangles.
inline constexpr int kMostFacetSteps = 12;

/// [1] Most facets on the way to a line. Fails first: if too small, lines fall back to flat triangles.
inline constexpr int kMostFacetsWalked = 400;

// smooth_cells

/// [edge] Room round a cell for the smooth surface between its corners. Fails first: if too small, contact inside a
/// cell is missed.
inline constexpr double kCellSlack = 0.5;

/// [room] Part of that room that a node may use. Fails first: if too large, nodes leave their cell's box.
inline constexpr double kCellBulge = 0.8;

/// [1] Cosine of a corner's normal with the mesh's. Fails first: if too small, the projection is on the other face of a
/// sheet.
inline constexpr double kSameNormalCosine = 0.5;

/// [1] Cosine of a corner's normal with a facet's at it (50 deg) below which it lies on a sharp edge. Fails first: if
/// too large, coarse round meshes have edges.
inline constexpr double kRidgeCosine = 0.64;

// smooth_depths

/// [edge] Distance before a corner at which its line begins (mean edges of the coarser mesh). Fails first: if too
/// small, contact of rough meshes begins unseen.
inline constexpr double kLayerLead = 0.5;

/// [edge] Distance outside of contact from which a corner has no depth. Fails first: if too small, cells at steep edges
/// of contact count by their nodes only.
inline constexpr double kLayerReachOut = 1.5;

/// [edge] Distance of the flat triangles from a corner up to which its cells are looked at. Fails first: if too small,
/// contact of rough meshes begins unseen.
inline constexpr double kCellNear = 0.4;

/// [edge] Highest bump inside a cell whose corners are clear. Fails first: if too small, contact between corners is
/// missed.
inline constexpr double kCellBump = 0.1;

/// [edge] Largest distance of a smooth surface from its triangles. Fails first: if too small, smooth layers fall back
/// to facets.
inline constexpr double kSmoothTrust = 1;

/// [1] Cosine of a ray with the normal that it meets. Fails first: if too small, grazing rays give infinite depth.
inline constexpr double kMinRayCosine = 0.1;

/// [1] Most cells at which the interpolation of the pressure is compared with the surface. Fails first: if too small,
/// the reported error is rough.
inline constexpr int kErrorSamples = 64;

/// [1] Error by the quadratic between nodes over what its middles show, or over their scatter (0.1 to 3.1 measured).
/// Fails first: if too small, reported errors of layers are too small.
inline constexpr double kInterpolationLeft = 4;

/// [1] Share of a cell's middle in the integral of a function that is 0 at its six nodes (exact for cubics). Fails
/// first: none; a rule of quadrature.
inline constexpr double kMiddleShare = 0.45;

/// [1] Error left by Richardson's extrapolation over the square of the removed one (0.04 to 0.17 measured). Fails
/// first: if too small, reported errors of layers are too small.
inline constexpr double kErrorLeft = 0.3;

/// [1] Steps to the deepest point of a layer. Fails first: if too small, peak pressure is low.
inline constexpr int kMaxDeepestSteps = 6;

/// [spacing] Longest of these steps. Fails first: if too large, it leaves the contact.
inline constexpr double kDeepestReach = 2;

/// [1] Most halvings of a layer's cells. Fails first: if too small, a layer misses its tolerance.
inline constexpr int kMaxLayerLevel = 4;

// swallowed

/// [1] Samples of an inner surface over its box. Fails first: if too small, swallowed parts are missed.
inline constexpr double kSwallowedSpacing = 10;

/// [spacing] Spacing of the outer samples that are looked at first. Fails first: if too large, slow search.
inline constexpr double kCoarseSampling = 3;

/// [distance] Motion, over the distance, for which a point keeps its side. Fails first: if too large, a change of side
/// is missed.
inline constexpr double kSideKept = 0.1;

/// [spacing] Error of facets about the smooth surface's side. Fails first: if too small, facets are called swallowed.
inline constexpr double kFacetError = 0.05;

// rim_cover

/// [disc radius] Distance of a ray from a border edge within which rounding decides its side. Fails first: if too
/// large, a step of the share in a crack of the mesh.
inline constexpr double kOnBorder = 1e-9;

/// [disc radius] Distance along a ray from where it meets a mesh within which the border cuts its disc: slopes up to 76
/// deg. Fails first: if too large, other borders behind cut it; if too small, a step at a steep rim.
inline constexpr double kRimDepth = 4;

/// [1] Border edges in a leaf of their tree. Fails first: if too large, slow search.
inline constexpr int kRimLeaf = 4;

// triangle_layer

/// [largest disc radius] Distance from their discs' border within which rays are listed for the rim. Fails first: if
/// too small, they are listed at every pose; if too large, many are listed (time).
inline constexpr double kRimMargin = 1;

/// [1] Least share of a triangle over the other mesh that carries load. Fails first: if too small, rounding counts as a
/// point of contact.
inline constexpr double kMinRimShare = 1e-9;

/// [1] Fewest rays of a layer cast on several threads. Fails first: if too small, overhead.
inline constexpr std::size_t kMinThreadedRays = 2000;

}  // namespace genu
