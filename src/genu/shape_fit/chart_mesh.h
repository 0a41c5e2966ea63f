// Triangles of a polynomial over a rectangle of its chart: a grid whose border lies on the rectangle's sides exactly,
// so that the mesh is the patch, all of it and nothing beyond.
#pragma once

#include <vector>

#include "genu/mesh/mesh.h"
#include "genu/surface/analytic.h"
#include "genu/surface/surface_chart.h"

namespace genu {

/// The polynomial h(u, v) over `box` as triangles whose edges are about `edge` (m) long and hardly longer; the lines of
/// the grid are closer where the surface is steep. Outward as make_polynomial and make_cylindrical_polynomial have it,
/// `inside` turns it round.
Mesh chart_mesh(const SurfaceChart& chart, const ChartBox& box, const std::vector<PolynomialTerm>& terms, bool inside,
                double edge);

}  // namespace genu
