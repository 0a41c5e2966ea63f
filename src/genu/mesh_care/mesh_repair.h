// Mends a mesh: what is wrong is taken out, and what is then missing is filled in. No vertex that stays is moved.
// Holes are filled by CGAL (Polygon Mesh Processing), smooth with what is round them.
#pragma once

#include <string>

#include "genu/mesh/mesh.h"

namespace genu {

struct RepairReport {
  std::string problem;            ///< why the mesh cannot be mended; empty where it was
  std::size_t turned = 0;         ///< triangles turned round, to agree with their neighbours or to face outward
  std::size_t removed = 0;        ///< triangles taken out: crossing, non-manifold, stray, inside others, degenerate
  std::size_t filled = 0;         ///< holes filled
  std::size_t left_open = 0;      ///< holes that could not be
  std::size_t new_triangles = 0;  ///< in the filled holes
};

/// False where genu was built with GENU_WITH_CGAL=OFF: repair_mesh() then changes nothing.
bool built_with_cgal();

/// Mends `mesh` as read_mesh() gave it. Borders of open sheets and of cut bones stay open. Without CGAL it is left as
/// it is, and `problem` says so.
RepairReport repair_mesh(Mesh& mesh);

}  // namespace genu
