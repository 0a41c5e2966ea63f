// The nodes of a smooth layer's lattice that one thread has visited, and their values at the current pose.
#pragma once

#include <cstdint>
#include <vector>

#include "genu/contact/curved_facets.h"
#include "genu/contact/quadratic_cell.h"
#include "genu/core/pose.h"

namespace genu {

struct SmoothNode {
  Vec3 x = Vec3::Zero();  ///< m, on the casting surface, in its body's frame
  Vec3 n = Vec3::UnitZ();
  bool ridge = false;        ///< `n` is a mean of two faces' normals (SmoothCells::Node)
  double own_thickness = 0;  ///< m, the part that does not depend on the pose
  int triangle = -1;         ///< of the target, met last

  std::uint64_t pose = 0;  ///< the pose of the values below
  bool met = false;        ///< the line along the normal meets the other surface
  bool listed = false;     ///< among SmoothNodes::carrying
  bool passed = false;     ///< a neighbouring node is deeper
  double depth = 0;        ///< m, negative outside of contact
  double thickness = 0;    ///< m, of both layers
  double p = 0;            ///< Pa, negative outside of contact
  double slope = 0;        ///< Pa/m: of the pressure, to the depth
  Vec6 p_rate;             ///< Pa/m, Pa: its derivative to the twist, casting axes
  double load = 0;         ///< N that the node represents
  double area = 0;         ///< m^2
  Vec6 load_rate;          ///< N/m, N
  int cell = -1;
};

/// Where the line from a corner leaves the flat triangles of the target.
struct CornerHit {
  std::uint64_t pose = 0;  ///< at which it does
  int triangle = -1;
  double depth = 0;  ///< m
};

/// A cell of the lattice: the part `number` of a triangle of the mesh. Its corners are (i, j) and two steps on from
/// there, forward or, `turned`, backward.
struct SmoothPart {
  int cell = 0, number = 0;
  int i = 0, j = 0;
  bool turned = false;
};

/// Of a part: what does not depend on the pose.
struct SmoothShape {
  std::array<int, 6> nodes;  ///< indices
  QuadraticCell integrals;
  SmoothCells::Node middle;
  bool middle_known = false;
};

struct SmoothNodes {
  int divisions = 0;       ///< of the lattice that the indices below belong to
  std::vector<int> place;  ///< by number: index into `nodes`, -1: not visited
  std::vector<SmoothNode> nodes;
  std::vector<int> carrying;   ///< indices of the nodes with pressure around them, in the order of the cells
  std::uint64_t pose = 0;      ///< counts the poses
  Pose at;                     ///< the last one,
  bool known = false;          ///< whether it was summed to the end,
  double load = 0, error = 0;  ///< N: and the sum there

  std::vector<CornerHit> corners;   ///< of each corner of the cells
  std::vector<int> reached;         ///< cells with a corner that has a hit at this pose
  std::vector<std::uint64_t> seen;  ///< of each cell: the pose at which it was listed
  std::vector<int> first_part;      ///< of each cell: index into `shape` of its first part, -1: not visited
  std::vector<int> shape;           ///< of each part: index into `shapes`, -1: not visited
  std::vector<SmoothShape> shapes;
  std::vector<SmoothPart> touching;  ///< parts with pressure
  CurvedFacets::Memory facets;
};

}  // namespace genu
