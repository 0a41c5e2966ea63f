// A solid that runs round a middle, as a meniscus does, cut across into pieces.
//
// The axis is that of the largest principal moment of inertia; it goes through the middle of the circle that fits the
// surface best. Cuts are half-planes of the axis, each across the solid's own curved centreline (the centroids of its
// sections), at equal distances along it.
#pragma once

#include <string>
#include <vector>

#include "genu/mesh/mesh.h"

namespace genu {

/// A cut across the solid. Lengths and moments are of its face, exact for the polyhedron.
struct MeshSection {
  Vec3 centre = Vec3::Zero();  ///< m: the face's centroid
  Vec3 tangent, y, z;          ///< unit, right-handed: the cut's normal, toward the next piece; the face's main axes
  double area = 0;             ///< m^2
  double about_y = 0;          ///< m^4: integral of z^2, the second moment for bending about y; at most about_z
  double about_z = 0;          ///< m^4: integral of y^2
};

struct MeshPiece {
  Mesh mesh;          ///< closed, in the frame of the whole
  Mesh above, below;  ///< its surface within 60 deg of facing along the axis, and against it: what bones touch
  double volume = 0;  ///< m^3
  Vec3 centroid;      ///< m
  double length = 0;  ///< m, along the centreline
};

struct MeshSegments {
  std::vector<MeshPiece> pieces;
  std::vector<MeshSection> sections;  ///< behind each piece; behind the last one too where the solid is a ring
  bool ring = false;                  ///< without a gap between two ends
  Vec3 middle = Vec3::Zero();         ///< m: of the axis, at the height of the centroid
  Vec3 axis = Vec3::UnitZ();
  std::string problem;  ///< why there are no pieces, as the end of a sentence about the mesh; empty: there are
};

/// Cuts a closed mesh, wound outward, into 3 pieces or more. Neighbours share the vertices of their faces.
MeshSegments segment_mesh(const Mesh& mesh, int pieces);

}  // namespace genu
