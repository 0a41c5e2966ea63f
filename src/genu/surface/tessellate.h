// Triangles for surfaces with a formula: a start mesh made for the shape (grid or geodesic), then refinement on any
// Surface. Every vertex lies on the surface; closed shapes come out closed, without seams or doubled vertices; the same
// input gives the same mesh.
#pragma once

#include <functional>

#include "genu/surface/surface.h"

namespace genu {

/// Distance of the rows of equilateral triangles, per edge length.
inline constexpr double kRowSpacing = 0.8660254037844386;

/// An edge (m) that follows a surface of this radius of curvature (m): at most half the radius, a chord of 29 deg.
double graded_edge(double edge, double radius);

/// The edge (m), made longer where an area (m^2) would need more than kMaxTriangles.
double affordable_edge(double edge, double area);

/// Divisions of `length` closest to `edge`; at least 3.
int grid_count(double length, double edge);

/// One direction of a grid: `count` divisions, and whether the last one joins the first.
struct GridAxis {
  int count = 1;
  bool closed = false;
};

/// A grid over (s, t) in [0, 1]^2 with outward side dp/ds x dp/dt. Where s closes, odd rows are shifted by half a
/// division, which makes the triangles nearly equilateral (a closed t then needs an even count).
Mesh grid_mesh(const GridAxis& s, const GridAxis& t, const std::function<Vec3(double, double)>& position);

/// The ellipsoid with these radii (m): an icosahedron whose faces are cut so finely that edges near the shortest radius
/// are about `edge` long, pushed outward. Where it is too coarse, refine() makes it finer.
Mesh geodesic_mesh(const Vec3& radii, double edge);

/// Drops triangles that lie wholly farther than `distance` (m) from `centre`, and vertices nothing uses any more.
void keep_near(Mesh& mesh, const Vec3& centre, double distance);

/// Splits edges longer than 4/3 of the local edge = min(edge, half the smaller radius of curvature) at their middle,
/// projected onto the surface, flips to Delaunay and relaxes inner vertices along the surface, until no edge is too
/// long or kMaxTriangles is reached. A mesh with no such edge is left as it is.
void refine(Mesh& mesh, const Surface& surface, double edge);

/// The smallest angle of any triangle (rad); pi/3 at best.
double smallest_angle(const Mesh& mesh);

}  // namespace genu
