// Places where a mesh is no surface: what is wrong there, where that is, and the mesh without it.
//
// A flaw matters where contact comes near it and nowhere else. So each becomes a hole with a known place: the triangles
// that are wrong are taken out, no vertex is moved, and whoever looks for contact is told where not to trust the rest.
#pragma once

#include <string>
#include <vector>

#include "genu/mesh/mesh.h"
#include "genu/surface/surface.h"

namespace genu {

struct Flaw {
  enum class Kind {
    non_manifold,  ///< an edge of more than two triangles
    unorientable,  ///< an edge along which no winding agrees
    crossing,      ///< triangles that run through each other
    spike,         ///< a vertex far out of the plane of its neighbours
    hole,          ///< a loop of free edges that is not the border of an open sheet
    stray_piece,   ///< a scrap beside the surface
    inner_piece    ///< a piece wholly inside another one: contact never gets there
  };
  Kind kind = Kind::hole;
  std::size_t count = 0;     ///< triangles taken out; of a hole: its free edges
  std::vector<Vec3> points;  ///< m, that stand for the place
  Vec3 centre = Vec3::Zero();
  double radius = 0;  ///< m, round the centre
};
const char* to_string(Flaw::Kind kind);

/// Finds the flaws of a mesh whose winding is consistent where it can be, and takes out the triangles that are wrong.
/// Flaws come kind by kind, the largest first.
std::vector<Flaw> cut_out_flaws(Mesh& mesh);

/// Where a flaw is, in the file's frame and unit: "12 triangles that run through each other near (1.2, 3, -4) mm".
/// `metres_per_unit` is that of the file.
std::string describe(const Flaw& flaw, double metres_per_unit);

/// A loop of free edges: a hole, or the border of an open sheet or of a cut bone?
struct FreeLoop {
  std::vector<int> vertices;  ///< surface on the left
  double length = 0;          ///< m
  bool border = false;
};
/// The border of an open sheet is the longest loop of its piece, if it is long for the piece's area; the end of a tube
/// (a shaft that was cut off) is a border too; all other loops are holes.
std::vector<FreeLoop> free_loops(const Mesh& mesh);

}  // namespace genu
