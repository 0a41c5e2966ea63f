// The facts about a mesh that decide whether contact can be trusted on it. Noise is judged where surfaces are fitted.
#pragma once

#include <array>
#include <string>

#include "genu/core/diagnostics.h"
#include "genu/mesh/mesh.h"
#include "genu/mesh/mesh_topology.h"

namespace genu {

struct MeshReport {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  int components = 0;              ///< sheets connected through edges
  std::size_t boundary_loops = 0;  ///< 0 for a closed surface, 1 for an open sheet without holes
  std::size_t boundary_edges = 0;
  std::size_t non_manifold_edges = 0;   ///< edges of more than two triangles
  std::size_t flipped = 0;              ///< triangles whose winding disagrees with most of their component
  bool orientable = true;               ///< false where no winding agrees everywhere
  std::size_t degenerate = 0;           ///< triangles without area, to the rounding of float32
  std::size_t slivers = 0;              ///< other triangles with an angle below kSliverAngle
  std::array<double, 5> edge_length{};  ///< m: shortest, 5 %, median, 95 %, longest
  BoundingBox box;                      ///< m
};

MeshReport check_mesh(const Mesh& mesh);

/// The first of kLengthUnits in which a box of this diagonal (file units) would be a knee's; empty where none fits.
std::string guess_unit(double diagonal);

/// Compares the size of a mesh with that of a knee's surfaces: a box diagonal between 5 mm and 500 mm. Outside 1 mm to
/// 5 m an error that names the unit it was probably written in, between the two a warning. `unit` is the one declared
/// for `file`, by its name in kLengthUnits.
void check_scale(const MeshReport& report, const std::string& file, const std::string& unit, Diagnostics& out);

}  // namespace genu
