// Every tolerance of the room `mesh`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

namespace genu {

// shared by rooms

/// [1] Twice a triangle's area over its longest side squared that is zero area. Fails first: if too small, the nearest
/// point on it has no side; if too large, thin triangles are left out of contact.
inline constexpr double kDegenerateSine = 1e-9;

// cell_lists

/// [1] Most cells of a search grid; larger cells are taken above it. Fails first: if too large, out of memory on meshes
/// with long boxes.
inline constexpr double kMaxGridCells = 1 << 22;

// coordinate_step

/// [step] Rounding of coordinates, as a share of a decimal step, above which the step cannot be recognised. Fails
/// first: if too large, random coordinates pass for rounded decimals.
inline constexpr double kDecimalStepMaxRounding = 0.02;

// mesh_check

/// [m] Smallest box diagonal of a knee's mesh. Fails first: if too large, small bones get a warning about their unit.
inline constexpr double kLikelyMinDiagonal = 5e-3;

/// [m] Largest box diagonal of a knee's mesh; the unit is guessed from both. Fails first: if too small, long bones get
/// a warning about their unit.
inline constexpr double kLikelyMaxDiagonal = 0.5;

/// [m] Box diagonal below which a mesh is refused. Fails first: if too small, a mesh in the wrong unit is accepted.
inline constexpr double kMinDiagonal = 1e-3;

/// [m] Box diagonal above which a mesh, or a patch, is refused. Fails first: if too large, a mesh in the wrong unit is
/// accepted.
inline constexpr double kMaxDiagonal = 5;

/// [1] Twice a triangle's area over the product of its two longest sides that is zero area in single precision. Fails
/// first: if too small, degenerate triangles get a normal made of round-off.
inline constexpr double kDegenerateAreaShare = std::numeric_limits<float>::epsilon();

/// [rad] Angle below which a triangle is a sliver (5 deg). Fails first: if too large, ordinary meshes are reported as
/// poor.
inline constexpr double kSliverAngle = 0.0873;

// mesh_coarsen

/// [1] Least cosine of the turn of a facet when an edge is collapsed (60 deg). Fails first: if too small, coarsened
/// meshes fold.
inline constexpr double kCoarsenMinCosine = 0.5;

// mesh_cut

/// [edge] A vertex that near to a cut is moved onto it. Fails first: if too small, the cut leaves slivers, and searches
/// for the closest triangle fail there.
inline constexpr double kCutSnapShare = 0.1;

// mesh_segments

/// [bins] Of the whole turn, to find the gap between a meniscus' horns. Fails first: if too small, a narrow gap is not
/// seen.
inline constexpr int kSpanBins = 1440;

/// [points] Of the centreline. Fails first: if too small, pieces differ in length.
inline constexpr int kCentrelinePoints = 180;

/// [1] Cosine of the angle between a normal and the axis up to which a triangle is of the wall that no bone touches (60
/// deg; published upper and lower surfaces of menisci keep to it, but for 0.7 % of one). Fails first: if too small, the
/// wall presses sideways where a bone comes near; if too large, slopes do not carry.
inline constexpr double kSteepestSide = 0.5;

// mesh_weld

/// [1] Vertices nearer than this share of the box's diagonal are welded. Fails first: if too large, thin sheets stick
/// together; if too small, cracks stay open.
inline constexpr double kWeldBoxShare = 1e-6;

/// [1] Relative rounding of single-precision coordinates up to which vertices are welded. Fails first: if too small,
/// meshes of binary STL stay open along edges.
inline constexpr double kWeldFloatUlps = 2 * std::numeric_limits<float>::epsilon();

// polygon_cut

/// [1] Area of a triangle over that of the polygon it is cut from that is zero area. Fails first: if too small,
/// round-off makes a straight corner reflex and a convex polygon is cut anew; if too large, a reflex corner is cut
/// across.
inline constexpr double kFlatEarShare = 1e-9;

/// [1] Most corners of a polygon that is cut by ears, which takes their number squared or more. Fails first: if too
/// small, large faces that are not convex are cut wrong, with a warning; if too large, a damaged file takes hours.
inline constexpr std::size_t kMaxEarCorners = 1000;

// sharp_corners

/// [1] Cosine of the angle between facets beyond which an edge is sharp (40 deg). Fails first: if too large, smooth
/// curvature is reported as an edge.
inline constexpr double kSharpEdgeCosine = 0.766;

// triangle_cluster

/// [1] Relative error allowed for a squared distance in single precision (ten roundings of 6e-8, with margin). Fails
/// first: if too small, a ray misses a triangle, and the load of a layer is too small.
inline constexpr float kSingleSquareSlack = 4e-6F;

/// [1] Relative growth of a cluster's sphere for single precision. Fails first: if too small, a ray misses a triangle
/// at the sphere's edge.
inline constexpr double kSingleRadiusSlack = 1e-6;

// triangle_ray

/// [m] Component of a segment below which it does not move along that axis. Fails first: if too large, short rays miss
/// boxes.
inline constexpr double kMinRayComponent = 1e-30;

// triangle_sheet

/// [1] Least cosine of a sheet's normals with its axis (50 deg). Fails first: if too small, a sheet is not
/// single-valued along rays.
inline constexpr double kSheetMinCosine = 0.6428;

/// [ray] Motion, over a ray's length, that turns it by kSheetMaxTurn. Fails first: if too large, a ray leaves its sheet
/// unseen.
inline constexpr double kSheetTurnShare = 0.1;

/// [rad] Largest turn of a ray while a sheet is valid (12 deg). Fails first: if too small, sheets are rebuilt often
/// (time).
inline constexpr double kSheetMaxTurn = 12 * M_PI / 180;

/// [rad] Least angle between rays and a sheet's axis for which a sheet is used (20 deg). Fails first: if too large,
/// sheets are seldom used (time).
inline constexpr double kSheetMinRayAngle = 20 * M_PI / 180;

/// [ray] Margin inside a sheet's cylinder, as a share of the ray's length. Fails first: if too small, rays near the rim
/// leave the sheet unseen.
inline constexpr double kSheetRoom = 0.1;

/// [ray] Width added to a sheet's cylinder. Fails first: if too small, sheets are rebuilt often (time).
inline constexpr double kSheetAside = 0.3;

/// [ray] Depth of a sheet's cylinder below its source. Fails first: if less than 1, rays end outside of the sheet.
inline constexpr double kSheetBelow = 1.1;

/// [ray] Height of a sheet's cylinder above its source. Fails first: if less than 1, rays begin outside of the sheet.
inline constexpr double kSheetAbove = 1.4;

/// [1] Most facets of a sheet; a larger one is not used. Fails first: if too small, no sheets on fine meshes (time).
inline constexpr int kMaxSheetFacets = 50000;

/// [1] Most facets that a walk along a ray crosses before it falls back to the tree. Fails first: if too small,
/// fall-backs (time).
inline constexpr int kMaxSheetSteps = 64;

/// [1] Relative rounding of distances and angles in tests of sheets. Fails first: if too small, facets at the rim are
/// lost.
inline constexpr double kSheetRounding = 1e-9;

// triangle_tree

/// [1] Relative growth of the tree's boxes. Fails first: if too small, round-off in the slab test loses a triangle in a
/// plane of the axes.
inline constexpr double kBoxGrowth = 1e-12;

// stair_steps

/// [1] Width of a cell of directions in which facets are counted. Fails first: if too large, the direction is blurred
/// by what is not flat.
inline constexpr double kStepDirectionCell = 0.01;

/// [1] Cosine of the angle (78 deg) between directions of steps. Fails first: if too large, one direction counts twice.
inline constexpr double kStepsAcross = 0.2;

/// [1] Ratio of heights of steps that are equal. Fails first: nothing (a choice among equals).
inline constexpr double kAlikeHeights = 1.01;

/// [1] Cosine of the angle (1 deg) within which a facet lies across the steps. Fails first: if too small, round parts
/// pass for steps.
inline constexpr double kFlatStep = 0.99985;

/// [edge] Spread of the heights of one level. Fails first: if too large, gentle slopes pass for steps.
inline constexpr double kLevelSpread = 0.02;

/// [spread] Heights further apart than this belong to two levels. Fails first: if too large, a rough plane has no
/// levels but one; if too small, rounding parts a level.
inline constexpr double kLevelGap = 0.25;

/// [1] Least share of the flat area that a level holds. Fails first: if too small, chance makes levels.
inline constexpr double kLeastLevelShare = 0.004;

/// [1] Fewest levels of a staircase. Fails first: if too small, a machined part has steps.
inline constexpr int kLeastLevels = 4;

/// [step] Deviation of a gap between levels from whole steps. Fails first: if too large, chance spaces levels.
inline constexpr double kEvenStep = 0.05;

/// [1] Share of gaps that are whole steps. Fails first: as kEvenStep.
inline constexpr double kEvenShare = 0.8;

/// [edge] Least height of steps. Fails first: if too small, coordinates rounded to few decimals pass for a staircase.
inline constexpr double kLeastStepHeight = 0.1;

/// [1] Least share of the mesh's area in flat steps. Fails first: if too large, staircases cut by bevels are missed.
inline constexpr double kLeastStepsShare = 0.1;

// vertex_fans

/// [1] Most rounds in which fans at pinched vertices are removed. Fails first: if too small, pinched vertices stay in
/// damaged meshes.
inline constexpr int kMaxFanRounds = 50;

// vertex_graph

/// [1] Cosine of normals (65 deg) beyond which a facet belongs to another sheet. Fails first: if too small, both faces
/// of a thin shell enter one fit.
inline constexpr double kConeCosine = 0.42;

/// [1] Widest fit patch over the root of a component's area. Fails first: if too large, a fit reaches round the whole
/// component.
inline constexpr double kMaxPatchOfSheet = 0.3;

// winding_number

/// [radius] Distance from which a group of triangles counts as a dipole in the winding number. Fails first: if too
/// small, inside and outside are confused near the surface.
inline constexpr double kDipoleDistance = 3;

}  // namespace genu
