// Joins what a mesh file has torn apart: STL repeats a vertex in each of its triangles, other formats repeat it for
// each texture coordinate or normal.
#pragma once

#include <cstddef>

#include "genu/mesh/mesh.h"

namespace genu {

struct WeldReport {
  std::size_t joined = 0;       ///< vertices equal to an earlier one: STL repeats each in all of its triangles
  std::size_t joined_near = 0;  ///< further vertices within the tolerance of an earlier one
  std::size_t degenerate = 0;   ///< triangles dropped because two of their corners became one
  std::size_t duplicate = 0;    ///< triangles dropped because another has the same corners, in either direction
  std::size_t both_ways = 0;    ///< triangles kept that stood there both ways round (two_sided.h chooses one)
};

/// Drops vertices that no triangle uses; the order of the others stays.
void drop_unused_vertices(Mesh& mesh);

/// The distance within which vertices are the same: 1e-6 of the bounding box' diagonal, or what the file's numbers
/// cannot tell apart (float32 at the largest coordinate, a finer decimal step), whichever is more. Same unit as the
/// mesh, which has to be the file's: only there can be seen how its numbers are rounded.
double weld_tolerance(const Mesh& mesh);

/// Makes one vertex of those nearer than `tolerance` to one that came before them (which stays where it is), drops
/// triangles that degenerate or repeat, and vertices nothing uses. Order is kept: the result never depends on hashing.
WeldReport weld(Mesh& mesh, double tolerance);

}  // namespace genu
