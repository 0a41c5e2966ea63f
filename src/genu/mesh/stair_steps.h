// The staircase of a segmentation that was not smoothed: its surface runs along the faces of voxels or the planes of
// slices, in flat steps of one height.
//
// Such a mesh is even where one looks closely, so nothing small-scale tells that its vertices are half a step off the
// surface that was measured. What does tell is the facets that face one direction exactly and lie in many planes,
// evenly spaced along it.
#pragma once

#include <optional>

#include "genu/mesh/mesh.h"

namespace genu {

struct StairSteps {
  Vec3 direction = Vec3::UnitZ();  ///< unit, across the flat steps, in the mesh's frame
  double height = 0;               ///< m, from step to step
  double share = 0;                ///< of the mesh's area that is flat steps
  int levels = 0;                  ///< planes that hold them
  /// m: root mean square distance of the mesh from the surface it stands for. Across even steps it is height /
  /// sqrt(12); steps in several directions add their squares.
  double rms = 0;
};

/// The highest steps of a mesh; none where there are no four levels, or they are not even.
std::optional<StairSteps> stair_steps(const Mesh& mesh);

}  // namespace genu
