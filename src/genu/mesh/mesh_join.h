// Pieces of one surface, each read from a file of its own, as one mesh.
#pragma once

#include <cstddef>
#include <vector>

#include "genu/mesh/mesh.h"

namespace genu {

struct JoinedMesh {
  /// Two pieces (a < b) with vertices in common.
  struct Border {
    std::size_t a = 0, b = 0;
    std::size_t vertices = 0;
  };
  Mesh mesh;
  std::vector<std::size_t> ends;  ///< of each piece the number of triangles up to its last one
  std::vector<Border> borders;    ///< ordered by a, then b
  std::size_t repeated = 0;       ///< triangles dropped because an earlier piece has them
};

/// All triangles of the pieces in their order, without those that repeat. Vertices within `tolerance` (m) of one of an
/// earlier piece become it, and so do a piece's own.
JoinedMesh join_pieces(const std::vector<Mesh>& pieces, double tolerance);

}  // namespace genu
