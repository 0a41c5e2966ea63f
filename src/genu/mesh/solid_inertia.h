// Volume, centroid and second moments of the solid that a closed mesh bounds: the divergence theorem, triangle by
// triangle, which is exact for the polyhedron (A. M. Messner and G. Q. Taylor 1980, ACM TOMS 6:121-128).
//
// With o near the centroid and a, b, c the corners of a triangle seen from o, the tetrahedron (o, a, b, c) has, d being
// a . (b x c) and s = a + b + c,
//   volume d / 6,   integral of x: d s / 24,   integral of x x^T: d (s s^T + a a^T + b b^T + c c^T) / 120.
#pragma once

#include "genu/mesh/mesh.h"

namespace genu {

/// Of unit density: times a density (kg/m^3) the mass, and the inertia in kg m^2.
struct SolidInertia {
  double volume = 0;                   ///< m^3; negative where the triangles face inward
  Vec3 centroid = Vec3::Zero();        ///< m
  Mat3 about_centroid = Mat3::Zero();  ///< m^5, in the mesh's axes; products as elements of the matrix
};

/// Of a closed mesh whose triangles are wound alike; pieces that lie inside others and face inward are cavities. Exact
/// but for rounding, wherever the mesh stands. Without volume the centroid is the middle of the vertices.
SolidInertia solid_inertia(const Mesh& mesh);

struct OutwardReport {
  std::size_t turned = 0;    ///< triangles of pieces that faced inward and are no cavities
  std::size_t cavities = 0;  ///< pieces inside others that faced outward as these do
  double cavity_volume = 0;  ///< m^3, of those
};

/// Turns each closed piece so that its side follows from how many others it lies in: outward for none, inward (a
/// cavity) for one, outward for two, and so on. A piece lies in another with all its vertices; pieces that cross are
/// not nested. For closed meshes, the triangles of each piece wound alike.
OutwardReport turn_outward(Mesh& mesh);

/// How small a volume is beside that of a ball of the same area: 1 for a ball, 0 for a sheet folded on itself.
double fullness(const Mesh& mesh, double volume);

}  // namespace genu
