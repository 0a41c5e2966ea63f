// Pieces of a mesh as meshes of their own.
#pragma once

#include <functional>

#include "genu/mesh/mesh.h"

namespace genu {

/// The triangles that `keep(centre, unit normal)` says, with the vertices they use, in their order. Triangles without
/// area are dropped.
Mesh part_of(const Mesh& mesh, const std::function<bool(const Vec3& centre, const Vec3& normal)>& keep);

/// The pieces that hang together through edges, the largest area first; pieces of less than `least_share` of the whole
/// area are left out.
std::vector<Mesh> sheets_of(const Mesh& mesh, double least_share);

/// The piece of the largest area; empty for an empty mesh.
Mesh largest_sheet(const Mesh& mesh);

/// m^2
double area_of(const Mesh& mesh);

}  // namespace genu
