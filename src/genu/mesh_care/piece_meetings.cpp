#include "genu/mesh_care/piece_meetings.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "genu/mesh/nearest_point.h"
#include "genu/mesh_care/mesh_crossings.h"
#include "genu/mesh_care/tolerances.h"

namespace genu {
namespace {

struct PieceReach {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::max());
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::max());

  void add(const Vec3& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); }
  bool is_near(const PieceReach& o, double margin) const {
    return ((low.array() - margin) <= o.high.array()).all() && ((o.low.array() - margin) <= high.array()).all();
  }
};

struct FilePiece {
  std::size_t first = 0, end = 0;  ///< triangles
  PieceReach box;
  std::set<int> vertices;
};

std::vector<FilePiece> file_pieces(const Mesh& mesh, const std::vector<std::size_t>& ends) {
  std::vector<FilePiece> pieces;
  std::size_t first = 0;
  for (const std::size_t end : ends) {
    FilePiece piece{first, end, {}, {}};
    for (std::size_t t = first; t < end; ++t)
      for (const int v : mesh.triangles[t]) {
        piece.vertices.insert(v);
        piece.box.add(mesh.vertices[static_cast<std::size_t>(v)]);
      }
    pieces.push_back(std::move(piece));
    first = end;
  }
  return pieces;
}

/// The least distance from vertices of `a` to triangles of `b`, where it is below `meeting.gap`.
void look_for_gap(const Mesh& mesh, const FilePiece& a, const FilePiece& b, PieceMeeting& meeting) {
  std::vector<Vec3> near;
  PieceReach all;
  for (const int v : a.vertices) {
    PieceReach point;
    point.add(mesh.vertices[static_cast<std::size_t>(v)]);
    if (!point.is_near(b.box, meeting.gap)) continue;
    near.push_back(point.low);
    all.add(point.low);
  }
  for (std::size_t t = b.first; t < b.end && !near.empty(); ++t) {
    PieceReach triangle;
    for (const int v : mesh.triangles[t]) triangle.add(mesh.vertices[static_cast<std::size_t>(v)]);
    if (!triangle.is_near(all, meeting.gap)) continue;
    const auto corner = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])]; };
    for (const Vec3& x : near) {
      PieceReach point;
      point.add(x);
      if (!point.is_near(triangle, meeting.gap)) continue;
      const double gap = (nearest_on_triangle(x, corner(0), corner(1), corner(2)) - x).norm();
      if (gap < meeting.gap) meeting.gap = gap, meeting.place = x;
    }
  }
}

bool have_common_vertices(const FilePiece& a, const FilePiece& b) {
  return std::any_of(a.vertices.begin(), a.vertices.end(), [&](int v) { return b.vertices.contains(v); });
}

}  // namespace

std::vector<PieceMeeting> piece_meetings(const Mesh& mesh, const std::vector<std::size_t>& ends) {
  std::map<std::pair<std::size_t, std::size_t>, PieceMeeting> found;
  const auto piece_of = [&](int t) {
    return static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), static_cast<std::size_t>(t)) -
                                    ends.begin());
  };
  for (const auto& [i, j] : crossing_triangles(mesh)) {
    const std::size_t a = piece_of(i), b = piece_of(j);
    if (a == b) continue;
    PieceMeeting& meeting = found[{a, b}];
    if (meeting.crossings++ > 0) continue;
    for (const int v : mesh.triangles[static_cast<std::size_t>(i)])
      meeting.place += mesh.vertices[static_cast<std::size_t>(v)] / 3;
  }
  const std::vector<FilePiece> pieces = file_pieces(mesh, ends);
  for (std::size_t b = 0; b < pieces.size(); ++b)
    for (std::size_t a = 0; a < b; ++a) {
      if (found.contains({a, b}) || have_common_vertices(pieces[a], pieces[b])) continue;
      PieceMeeting meeting;
      meeting.gap = kPiecesTouch;
      look_for_gap(mesh, pieces[a], pieces[b], meeting);
      look_for_gap(mesh, pieces[b], pieces[a], meeting);
      if (meeting.gap < kPiecesTouch) found[{a, b}] = meeting;
    }
  std::vector<PieceMeeting> out;
  for (auto& [pair, meeting] : found) {
    meeting.a = pair.first;
    meeting.b = pair.second;
    out.push_back(meeting);
  }
  return out;
}

}  // namespace genu
