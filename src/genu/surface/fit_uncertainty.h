// What noise in a mesh's vertices does to its blend: standard deviations of height, slope and curvature.
//
// Each of them, at a point of the blend, is a linear functional a . z of the heights z of the vertices in reach: least
// squares fits are linear in their data, and the blend's weights do not depend on it. So its variance is a^T C a with
// the noise's covariance C_ij = s^2 exp(-|x_i - x_j|^2 / l^2). Here a is taken once for each degree from a blend of
// flat, regular vertices; with z = rho * Z and x = rho * X it depends on nothing else, and
//     sigma_curvature = (s / rho) / rho * G(degree, l / rho),
// for white noise of vertices an edge h apart G = c h / rho with c = 9, 15, 26 for degree 2, 3, 4. (A single fit has 5,
// 5, 20 at its centre, where it is best known; a blend looks at fits off their centres, and at how they differ.) Noise
// that is correlated over l acts like white noise of vertices 1.9 l apart, until l comes near the fit radius.
//
// Measured (fit_uncertainty_test.cpp): within 30 % of the scatter over perturbed flat, torus and bowl meshes, white and
// correlated. Near the edges of a mesh, and where fits had to widen, it is more (edges) or less than this.
#pragma once

#include "genu/surface/mesh_noise.h"

namespace genu {

struct FitUncertainty {
  double height = 0;     ///< m
  double slope = 0;      ///< rad, of the normal, about one tangent
  double curvature = 0;  ///< 1/m, of the normal curvature in one direction
};

/// `edge` is the vertices' distance (m), degree 2 to 4.
FitUncertainty fit_uncertainty(const MeshNoise& noise, double edge, double fit_radius, int degree);

}  // namespace genu
