// A coarser mesh of the same surface, made of vertices it has: what a scan with fewer points would have given.
//
// The shortest edge first, one end of it is drawn into the other, until the vertices are as few as longer edges ask
// for. Vertices stay where they are, so that a coarser mesh carries the noise of the finer one and none of its own.
// Sheets, holes and edges stay what they were: boundary vertices are drawn along their boundary alone, and an edge
// whose ends share more neighbours than its triangles have corners beside it stays (H. Hoppe et al. 1993, "Mesh
// optimization": the link condition).
#pragma once

#include "genu/mesh/mesh.h"

namespace genu {

/// A mesh whose edges are about `factor` (>= 1) times longer, with 1 / factor^2 of the vertices, unless its shape keeps
/// it finer: no triangle turns by more than 60 degrees. Edges with more than two triangles stay as they are. The
/// vertices keep their order.
Mesh coarsened(const Mesh& mesh, double factor);

}  // namespace genu
