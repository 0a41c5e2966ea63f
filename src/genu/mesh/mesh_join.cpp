#include "genu/mesh/mesh_join.h"

#include <map>
#include <set>
#include <utility>

#include "genu/mesh/mesh_weld.h"

namespace genu {
namespace {

std::vector<JoinedMesh::Border> borders_of(const JoinedMesh& joined) {
  std::vector<std::set<std::size_t>> users(joined.mesh.vertices.size());
  std::size_t piece = 0;
  for (std::size_t t = 0; t < joined.mesh.triangles.size(); ++t) {
    while (t >= joined.ends[piece]) ++piece;
    for (const int v : joined.mesh.triangles[t]) users[static_cast<std::size_t>(v)].insert(piece);
  }
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> counts;
  for (const auto& pieces : users)
    for (auto a = pieces.begin(); a != pieces.end(); ++a)
      for (auto b = std::next(a); b != pieces.end(); ++b) ++counts[{*a, *b}];
  std::vector<JoinedMesh::Border> out;
  for (const auto& [pair, count] : counts) out.push_back({pair.first, pair.second, count});
  return out;
}

}  // namespace

JoinedMesh join_pieces(const std::vector<Mesh>& pieces, double tolerance) {
  JoinedMesh joined;
  for (const Mesh& piece : pieces) {
    const int first = static_cast<int>(joined.mesh.vertices.size());
    joined.mesh.vertices.insert(joined.mesh.vertices.end(), piece.vertices.begin(), piece.vertices.end());
    for (const auto& t : piece.triangles) joined.mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    // After each piece, so that what is dropped is known to be this one's: of equal triangles the first stays.
    joined.repeated += weld(joined.mesh, tolerance).duplicate;
    joined.ends.push_back(joined.mesh.triangles.size());
  }
  joined.borders = borders_of(joined);
  return joined;
}

}  // namespace genu
