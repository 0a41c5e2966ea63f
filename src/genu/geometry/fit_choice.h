// How wide the local fits of a blend should be: as narrow as the mesh allows, as wide as its noise asks for.
//
// Without noise the radius is 3 h (h the median edge), so that refining the mesh converges. Noise in the vertices makes
// the curvature of a fit err by an amount that falls with the cube of the radius. That error is measured as the
// disagreement of two fits 0.7 radii apart about the curvature half-way between them, which sees the correlated noise
// of a segmentation as it acts (the residuals of a fit, which follows such noise, do not). Truncation makes fits
// disagree too, but grows with the square of the radius: two radii tell them apart. The radius is then the smallest
// that brings the error below 0.15 of the mean curvature of the flatter parts of the surface; sharply curved places,
// where the same error matters less and truncation more, may be fitted more narrowly.
#pragma once

#include <optional>
#include <string>

#include "genu/geometry/mesh.h"
#include "genu/geometry/vertex_graph.h"

namespace genu {

struct FitChoice {
  int degree = 3;
  double radius = 0;        ///< m
  double least_radius = 0;  ///< m: a sharply curved place may be fitted as narrowly as this
  double noise_rms = 0;     ///< m, of the vertices about the narrowest fits; correlated noise counts in part only
  std::string why;
};

/// A radius (m) or degree that is given is taken as it is. Deterministic, and independent of the number of threads.
FitChoice choose_fit(const Mesh& mesh, const VertexGraph& graph, std::optional<double> radius,
                     std::optional<int> degree);

}  // namespace genu
