#include "genu/assemble/piece_notes.h"

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/mesh_care/piece_meetings.h"

namespace genu {

std::string pieces_text(const PieceFiles& files, const std::vector<JoinedMesh::Border>& borders) {
  if (!files.several()) return "";
  std::string text = fmt::format("{} files", files.paths.size());
  for (const JoinedMesh::Border& b : borders)
    text += fmt::format(", {} and {} joined along {} vertices", files.paths[b.a], files.paths[b.b], b.vertices);
  return text + (borders.empty() ? " of pieces that share no vertex; " : "; ");
}

void warn_meetings(const Mesh& mesh, const std::vector<std::size_t>& ends, const SurfaceDef& def, Diagnostics& out) {
  if (ends.empty()) return;
  for (const PieceMeeting& m : piece_meetings(mesh, ends)) {
    const Vec3 at = m.place / def.file_unit;
    const std::string there =
        fmt::format("{} near ({:.4g}, {:.4g}, {:.4g})", def.file.paths[m.a], at.x(), at.y(), at.z());
    out.warning(Code::mesh_flawed, def.file.paths[m.b],
                m.crossings > 0
                    ? fmt::format("overlaps {}: {} pairs of triangles run through each other", there, m.crossings)
                    : fmt::format("comes within {:.2g} mm of {} and shares no vertex with it: between them the surface "
                                  "has a slit with two edges",
                                  to::kMillimetre * m.gap, there));
  }
}

}  // namespace genu
