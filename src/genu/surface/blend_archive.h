// The parts of a surface made of a mesh, for an archive (core/binary_archive.h).
#pragma once

#include "genu/surface/blend_surface.h"

namespace genu {

template <typename Archive>
void serialize(Archive& a, Mesh& x) {
  a(x.vertices, x.triangles);
}
template <typename Archive>
void serialize(Archive& a, MeshNoise& x) {
  a(x.rms, x.correlation_length);
}
template <typename Archive>
void serialize(Archive& a, FitUncertainty& x) {
  a(x.height, x.slope, x.curvature);
}
template <typename Archive>
void serialize(Archive& a, BlendFacts& x) {
  a(x.degree, x.fit_radius, x.blend_radius, x.node_spacing, x.node_count, x.sheet_count, x.median_edge, x.noise,
    x.uncertainty, x.why);
}
template <typename Archive>
void serialize(Archive& a, DoubtfulPlace& x) {
  a(x.what, x.points, x.reach, x.missing);
}

}  // namespace genu
