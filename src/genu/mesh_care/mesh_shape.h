// The shape of a mesh in a few numbers, measured at a sample of its vertices.
#pragma once

#include <array>
#include <optional>

#include "genu/mesh/mesh.h"
#include "genu/mesh/stair_steps.h"

namespace genu {

struct MeshShape {
  double noise = 0;                   ///< m, rms of the vertices about the surface (fit_choice.h)
  std::optional<StairSteps> steps;    ///< of a segmentation that was not smoothed
  double fit_radius = 0;              ///< m, as a scene would use it
  int fits = 0;                       ///< how many vertices the next two were measured at
  std::array<double, 3> curvature{};  ///< 1/m: 1 %, median, 99 % of both principal curvatures, > 0 bulges outward
  double sharpest = 0;                ///< 1/m: 95 % of the larger |principal curvature| at each vertex
  int thickness_rays = 0;             ///< how many rays met the surface again, the wrong way round
  std::array<double, 3> thickness{};  ///< m: 5 %, median, 95 % of their lengths, inward along the normal
};

/// Of a mesh without flaws, its triangles wound alike.
MeshShape shape_of(const Mesh& mesh);

/// Which way the pieces face.
struct Orientation {
  int closed_pieces = 0;
  int inside_out = 0;          ///< closed pieces of negative volume
  double open_area = 0;        ///< m^2 of the open pieces
  Vec3 facing = Vec3::Zero();  ///< of those: the mean normal, weighted by area
};
Orientation orientation_of(const Mesh& mesh);

/// Turns closed pieces of negative volume round, if another one has a positive volume: files do not mix the two on
/// purpose, except for cavities, which lie inside another piece. Returns how many triangles were turned.
std::size_t turn_odd_pieces(Mesh& mesh);

}  // namespace genu
