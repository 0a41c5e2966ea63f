// Two-sided exports: each triangle stands in the file twice, once each way round.
#pragma once

#include <vector>

#include "genu/mesh/mesh.h"

namespace genu {

/// Turns triangles that a file has both ways round (`both_ways`, one for each triangle): next to triangles that it has
/// one way round they agree with these; a piece of them alone agrees in itself, and faces outward where it is closed,
/// else as its first triangle does. Edges with more than two triangles are not crossed.
void choose_sides(Mesh& mesh, const std::vector<bool>& both_ways);

}  // namespace genu
