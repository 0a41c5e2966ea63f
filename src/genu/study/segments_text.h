// The pieces of a meniscus as part of a scene: bodies with their meshes, tied by bushings.
//
// The bushing at a cut stands for the beam between the centroids of the two pieces beside it, of length l, with the
// section's area A, shear factor 5/6, and second moments: E A / l and 5/6 G A / l, E I_y / l and E I_z / l, and G J / l
// with J = 4 I_y I_z / (I_y + I_z), exact for an ellipse (S. Timoshenko and J. N. Goodier, Theory of Elasticity, 1970).
#pragma once

#include <string>
#include <vector>

#include "genu/mesh/mesh_segments.h"

namespace genu {

struct SegmentsText {
  std::string name;              ///< of the meniscus: pieces are NAME_01, NAME_02, ...
  std::string parent;            ///< body in whose frame the mesh is given
  double modulus = 0;            ///< Pa, along the centreline
  double shear_modulus = 0;      ///< Pa
  double density = 0;            ///< kg/m^3, for the masses
  std::string above{}, below{};  ///< surfaces of bones that the pieces' two sides are in contact with; may be empty
};

/// "NAME_07" of the piece with index 6.
std::string piece_name(const std::string& name, int piece, int pieces);

/// Six numbers of the bushing between piece `section` and the next: N/m along the section's tangent, y and z, N m/rad
/// about them.
Vec6 section_stiffness(const MeshSegments& segments, int section, const SegmentsText& of);

/// The beginning of each such text, by which it is recognised.
inline constexpr char kSegmentsTitle[] = "# genu segment: ";

/// For a scene in mm and deg, beside the meshes NAME_01_above.stl and NAME_01_below.stl of the pieces' sides about
/// their centroids.
std::string segments_text(const MeshSegments& segments, const SegmentsText& of);

}  // namespace genu
