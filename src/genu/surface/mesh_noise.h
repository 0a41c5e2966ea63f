// The noise of a mesh: how far its vertices are off the surface that was measured, and over what length they err alike.
//
// A fit follows noise that is correlated over its radius, so residuals at one radius see only a part of it. What tells
// noise from shape is how the two spread over polynomial degrees and patch radii (patch_shells.h). On a patch of radius
// rho the part of degree m that a smooth shape has is close to
//     A^2 (rho / L)^(2m)           (A apart for even and odd m: symmetric shapes have one of them only)
// with a length L of the order of the radius of curvature: it falls fast with the degree. Noise of rms s and
// correlation exp(-r^2 / l^2) has s^2 e_m(rho / l), a known function that hardly falls with the degree once rho exceeds
// l. The medians over the mesh of degrees 2 to 5 and the rest, at radii from 3 to 17 edges, are compared with
//     A_even^2, A_odd^2, L, s, l
// in their logarithms; of lengths l that do about as well, one on the short side (the less noise) is taken. So
// truncation of curvature is no noise: exact shapes give 0. Measured (mesh_noise_test.cpp): s and l within a factor of
// 2 wherever noise stands out of the shape.
//
// What it cannot see: noise that looks like shape. That is noise correlated over more than about half the radius of
// curvature, or so weak that the shape hides it in all of these bands; a mesh whose edges are longer than a quarter of
// its radius of curvature hides any. Conversely what a surface really has at the scale of its edges (a ridge, steps of
// a segmentation) counts as noise, as it should for the fits. Of a measured knee's coarser meshes (edges 1.2 to 5 mm)
// the vertices are 23, 79 and 230 um (femur) and 27, 29 and 59 um (tibia) off the smooth surface of the finest; seen
// are 62, 204 and 506 um, and 26, 20 and 131 um: on the femur, which no short power series describes, too much.
#pragma once

#include "genu/mesh/mesh.h"
#include "genu/mesh/vertex_graph.h"

namespace genu {

struct MeshNoise {
  double rms = 0;                 ///< m, of the vertices' heights about the surface
  double correlation_length = 0;  ///< m, where the correlation has fallen to 1/e; 0: white
};

/// 0 where no noise is seen. Deterministic, and independent of the number of threads.
MeshNoise estimate_noise(const Mesh& mesh, const VertexGraph& graph);

}  // namespace genu
