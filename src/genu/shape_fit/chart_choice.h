// Which chart a piece of surface wants, and where to put its frame.
//
// A piece whose normals stay within a cone is a height over a plane; one that bends further wraps round an axis. The
// frame of a plane is made a function of the surface and the patch alone, not of how it is cut into triangles: origin
// on the surface at the middle of the patch, z the normal there, x along the longer side. An axis has no such place of
// its own on a condyle, which is nearly as round across as along: it is taken from what is known about the piece.
#pragma once

#include <vector>

#include "genu/mesh/mesh.h"
#include "genu/shape_fit/polynomial_fit.h"
#include "genu/surface/surface_chart.h"

namespace genu {

/// v, or -v where that makes its largest component positive.
Vec3 largest_positive(const Vec3& v);

/// A surface as points with normals, each standing for an area.
struct OrientedPoint {
  Vec3 p = Vec3::Zero();   ///< m
  Vec3 n = Vec3::UnitZ();  ///< unit
  double area = 0;         ///< m^2
};

/// The vertices of a mesh, with the normals and areas of the triangles round them.
std::vector<OrientedPoint> oriented_points(const Mesh& mesh);

/// Does it bend too far for a height over a plane? True where more than a twentieth of the area faces farther than
/// 60 deg away from the mean normal.
bool wraps_round(const std::vector<OrientedPoint>& points);

/// The frame with z along the mean normal, at the centroid.
Pose plane_frame(const std::vector<OrientedPoint>& points);

/// The principal directions of the normals, the one they are most perpendicular to first; largest components positive.
std::vector<Vec3> normal_axes(const std::vector<OrientedPoint>& points);

/// The frame whose z is `axis`, through the centre of the circle that the points seen along it lie on (least squares),
/// and whose x points to the mean of the points.
Pose axis_frame(const std::vector<OrientedPoint>& points, const Vec3& axis);

/// Whether the outward side of a surface in a chart is the one toward the axis (or down).
bool faces_inward(const SurfaceChart& chart, const std::vector<OrientedPoint>& points);

/// The cartesian chart turned about its z so that x is the principal axis of the zone's projection, its largest
/// component in the body positive. Exact integrals over the triangles: a rectangle's own sides come out to rounding.
void align_with_zone(const Mesh& zone, SurfaceChart& chart);

/// The chart moved so that the middle of `box` has the coordinates (0, 0); the box moves along.
void centre_on(ChartBox& box, SurfaceChart& chart);

/// The cartesian chart moved so that the polynomial, given in it, starts level from its origin: z is its normal there.
SurfaceChart level_chart(const SurfaceChart& chart, const std::vector<PolynomialTerm>& terms);

/// How far two charts are apart: the angle (rad) and the distance of the origins over `length` (m) together.
double chart_difference(const SurfaceChart& a, const SurfaceChart& b, double length);

}  // namespace genu
