// A closed triangle mesh of a solid that a function describes.
//
// Marching tetrahedra (A. Doi and A. Koide 1991) on cubes cut into six tetrahedra each, which neighbours cut alike:
// each edge of the grid whose ends lie on two sides gets one vertex, each tetrahedron with ends on both sides one or
// two triangles, and so the mesh is closed and a manifold whatever the function is. Its vertices are put onto the
// surface, short edges drawn together (mesh_coarsen.h, which keeps a manifold one), and what is left is made even
// (refine()).
#pragma once

#include <functional>
#include <string>

#include "genu/mesh/mesh.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/shape_fit/solid_field.h"

namespace genu {

/// The surface f = 0 inside a box, f < 0 being inside and > 0 on the whole of the box's sides, from cubes with edges of
/// `cell` (m). Vertices lie on edges of the grid, between a tenth and nine tenths of their lengths.
Mesh marching_tetrahedra(const std::function<double(const Vec3&)>& f, const BoundingBox& box, double cell);

/// Triangles with edges of about `edge` (m), outward normals, every vertex on the surface. What is thinner than an edge
/// may be lost. Empty, with the reason in `why`, where nothing as large as an edge is inside, where more triangles than
/// kMaxTriangles would be needed, or where the surface is too sharp to be followed.
Mesh solid_mesh(const SolidField& field, double edge, std::string& why);

}  // namespace genu
