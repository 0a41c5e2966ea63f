// Points that stand for a surface when its distance to another one is looked at everywhere.
#pragma once

#include <vector>

#include "genu/mesh/mesh.h"

namespace genu {

/// Samples of a surface in the frame of its body, with the graph of their neighbours (compressed rows).
struct SampleSet {
  std::vector<Vec3> points;          ///< m, on the surface
  std::vector<Vec3> normals;         ///< outward, unit
  std::vector<double> areas;         ///< m^2, the share of the surface that each point stands for
  std::vector<int> first_neighbour;  ///< size points + 1
  std::vector<int> neighbours;       ///< neighbours of i: [first_neighbour[i], first_neighbour[i + 1])

  int size() const { return static_cast<int>(points.size()); }
};

/// The vertices of a mesh as samples: a third of the area of each triangle to each of its corners.
SampleSet vertex_samples(const Mesh& mesh);

/// A part of the samples that keep `spacing` (m) from each other on the same side of the surface, chosen in their
/// order; areas go to the nearest that is kept, neighbours are those within twice the spacing.
SampleSet thin_samples(const SampleSet& set, double spacing);

}  // namespace genu
