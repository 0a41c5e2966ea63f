// Creases, rims and corners of a mesh: where it bends within a few edges and is even beside that, as a machined solid
// does or a closed shell round its rim. A fit does not reach over them, and what lies near them says nothing about the
// noise of the rest.
//
// Seen from the heights that no polynomial of degree 5 has on a patch of 3 edges (patch_shells.h). On bones and
// cartilage the worst patches have at most 36 times what the quiet tenth has; at the rim of a shell and the corner of a
// solid it is 40 times to any number. Where the quiet ones are even to the rounding of the coordinates (a machined
// shape) that is enough; where they are rough a patch must bend by 30 deg as well. Edges that bend by 60 deg are folds
// in any case.
#pragma once

#include "genu/mesh/vertex_graph.h"

namespace genu {

/// The graph of a mesh with its creases (VertexGraph::on_crease, near_crease), which stay empty where the mesh has
/// none. The edges of a staircase are none: it stands for a surface that has none (VertexGraph::steps). Deterministic,
/// and independent of the number of threads.
VertexGraph graph_with_creases(const Mesh& mesh);

}  // namespace genu
