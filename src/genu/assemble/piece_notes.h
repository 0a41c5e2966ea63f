// What is said of a surface whose pieces are in several files.
#pragma once

#include <string>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/mesh/mesh_join.h"
#include "genu/scene/surface_def.h"

namespace genu {

/// For the summary: how the pieces hang together, and "; " for what follows. Empty where there is one file.
std::string pieces_text(const PieceFiles& files, const std::vector<JoinedMesh::Border>& borders);

/// Warns of pieces that run through each other or nearly touch. `mesh` and `ends` as read, `ends` empty where there is
/// one file.
void warn_meetings(const Mesh& mesh, const std::vector<std::size_t>& ends, const SurfaceDef& def, Diagnostics& out);

}  // namespace genu
