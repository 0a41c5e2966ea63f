// Smooths a mesh without shrinking it: for the staircases of segmentations (stair_steps.h).
#pragma once

#include "genu/mesh/mesh.h"

namespace genu {

struct SmoothReport {
  double rms = 0, largest = 0;                 ///< m, how far vertices were moved
  int held = 0;                                ///< vertices that would have moved by more than the bound
  double volume_before = 0, volume_after = 0;  ///< m^3; 0 where the mesh is not closed
};

/// Moves the vertices of `mesh` by at most `bound` (m > 0) each. Steps of shrinking and of growing take turns (Taubin
/// 1995), so that what is wider than about kSmoothedEdges edges stays; then the volume of a closed mesh is put back.
/// The vertices of free borders move along them only.
SmoothReport smooth_mesh(Mesh& mesh, double bound);

}  // namespace genu
