// Where the pieces of a surface, each from a file of its own, run through each other or nearly touch.
#pragma once

#include <cstddef>
#include <vector>

#include "genu/mesh/mesh.h"

namespace genu {

/// Two pieces (a < b).
struct PieceMeeting {
  std::size_t a = 0, b = 0;
  std::size_t crossings = 0;  ///< pairs of triangles that run through each other
  double gap = 0;             ///< m: where there are none, the least distance, below kPiecesTouch
  Vec3 place = Vec3::Zero();  ///< m: one of the places
};

/// `ends` as of JoinedMesh. Pieces that share vertices are joined there and are not looked at for gaps.
std::vector<PieceMeeting> piece_meetings(const Mesh& mesh, const std::vector<std::size_t>& ends);

}  // namespace genu
