// How wide the local fits of a blend should be: as narrow as the mesh allows, as wide as its noise asks for.
//
// Without noise the radius is 3 h (h the median edge), so that refining the mesh converges. Noise in the vertices makes
// the curvature of a fit err by an amount that falls with the cube of the radius. That error is measured as the
// disagreement of two fits 0.7 radii apart about the curvature half-way between them, which sees the correlated noise
// of a segmentation as it acts (the residuals of a fit, which follows such noise, do not). Truncation makes fits
// disagree too, but grows with the square of the radius: two radii tell them apart. The radius is then the smallest
// that brings the error below 0.15 of the mean curvature of the flatter parts of the surface; sharply curved places,
// where the same error matters less and truncation more, may be fitted more narrowly.
//
// The noise itself (mesh_noise.h) is estimated from another side and says what the chosen fit is worth
// (fit_uncertainty.h). On a measured knee the two sides agree: at 3 edges fits disagree by 35 (femur) and 44 1/m
// (tibia) where the noise seen, 24 um over 1.1 mm, lets the blend err by 28.
//
// Degree 3 unless the scene asks for another: the radius suits the degree. Under noise of 15 to 50 um degree 3 erred by
// at most 1.4 times what the best of 2, 3 and 4 did, on tori, ellipsoids and knees; 2 and 4 by up to 2.8 times. Degree
// 4 is the best without noise, but the disagreement of fits does not tell: both fits of a pair err alike by truncation.
// The edges of a staircase (stair_steps.h) are no shape: fits reach over 3 of its steps at least, and its noise is that
// of even steps, height / sqrt(12), alike over a step.
// A machined shape with creases has degree 4: no noise, and beside a crease fits have one side only, where truncation
// is at its worst.
// Nodes stand a quarter of the fit radius apart, whatever the noise: the blend's own error is then well below a fit's.
// Thickness sets no limit: a fit walks over its own face, and faces that a point could see together are parted into
// sheets (blend_nodes.h).
#pragma once

#include <optional>
#include <string>

#include "genu/mesh/mesh.h"
#include "genu/mesh/vertex_graph.h"
#include "genu/surface/fit_uncertainty.h"
#include "genu/surface/mesh_noise.h"

namespace genu {

struct FitChoice {
  int degree = 3;
  double radius = 0;        ///< m
  double least_radius = 0;  ///< m: a sharply curved place may be fitted as narrowly as this
  MeshNoise noise;
  FitUncertainty uncertainty;  ///< what that noise does to a blend of this degree and radius
  std::string why;
};

/// A radius (m) or degree that is given is taken as it is. Deterministic, and independent of the number of threads.
FitChoice choose_fit(const Mesh& mesh, const VertexGraph& graph, std::optional<double> radius,
                     std::optional<int> degree);

}  // namespace genu
