#include "genu/mesh_care/mesh_flaws.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "genu/core/length_units.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/mesh/sharp_corners.h"
#include "genu/mesh/winding_number.h"
#include "genu/mesh_care/mesh_crossings.h"
#include "genu/mesh_care/tolerances.h"

namespace genu {
namespace {

Vec3 area_vector(const Mesh& mesh, const std::array<int, 3>& t) {
  return 0.5 *
         (mesh.vertices[at(t[1])] - mesh.vertices[at(t[0])]).cross(mesh.vertices[at(t[2])] - mesh.vertices[at(t[0])]);
}

bool runs(const std::array<int, 3>& t, int a, int b) {
  return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
}

/// Marks triangles on edges of more than two.
void mark_non_manifold(const Mesh& mesh, const std::vector<MeshEdge>& edges, std::vector<char>& wrong, char mark) {
  std::vector<std::array<int, 2>> bad;  // sorted, as the edges are
  for (const MeshEdge& e : edges)
    if (e.count > 2) bad.push_back(e.v);
  if (bad.empty()) return;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      if (std::binary_search(bad.begin(), bad.end(), std::array{std::min(a, b), std::max(a, b)})) wrong[t] = mark;
    }
}

void mark_unorientable(const Mesh& mesh, const std::vector<MeshEdge>& edges, std::vector<char>& wrong, char mark) {
  for (const MeshEdge& e : edges) {
    if (e.count != 2) continue;
    if (runs(mesh.triangles[at(e.t[0])], e.v[0], e.v[1]) != runs(mesh.triangles[at(e.t[1])], e.v[0], e.v[1])) continue;
    for (const int t : e.t)
      if (wrong[at(t)] == 0) wrong[at(t)] = mark;
  }
}

void set_place(const Mesh& mesh, const std::vector<int>& triangles, Flaw& flaw) {
  std::vector<int> vertices;
  for (const int t : triangles)
    vertices.insert(vertices.end(), mesh.triangles[at(t)].begin(), mesh.triangles[at(t)].end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  for (const int v : vertices) flaw.points.push_back(mesh.vertices[at(v)]);
}

void set_ball(Flaw& flaw) {
  if (flaw.points.empty()) return;
  Vec3 low = flaw.points[0], high = low;
  for (const Vec3& p : flaw.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  flaw.centre = 0.5 * (low + high);
  for (const Vec3& p : flaw.points) flaw.radius = std::max(flaw.radius, (p - flaw.centre).norm());
}

/// The marked triangles as places: what hangs together by vertices is one.
void add_places(const Mesh& mesh, const std::vector<char>& wrong, char mark, Flaw::Kind kind, std::vector<Flaw>& out) {
  std::vector<int> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[at(v)] != v) v = parent[at(v)] = parent[at(parent[at(v)])];
    return v;
  };
  std::vector<std::pair<int, int>> marked;  // root, triangle
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    if (wrong[t] != mark) continue;
    for (const int v : mesh.triangles[t]) {
      const int a = root(v), b = root(mesh.triangles[t][0]);
      parent[at(std::max(a, b))] = std::min(a, b);
    }
    marked.emplace_back(0, static_cast<int>(t));
  }
  for (auto& [r, t] : marked) r = root(mesh.triangles[at(t)][0]);
  std::sort(marked.begin(), marked.end());
  for (std::size_t first = 0; first < marked.size();) {
    std::vector<int> triangles;
    const int r = marked[first].first;
    for (; first < marked.size() && marked[first].first == r; ++first) triangles.push_back(marked[first].second);
    Flaw flaw;
    flaw.kind = kind;
    flaw.count = triangles.size();
    set_place(mesh, triangles, flaw);
    out.push_back(std::move(flaw));
  }
}

void remove_marked(Mesh& mesh, std::vector<char>& wrong, char mark) {
  std::size_t index = 0;
  std::vector<char> kept;
  std::erase_if(mesh.triangles, [&](const auto&) {
    const bool gone = wrong[index++] == mark;
    if (!gone) kept.push_back(wrong[index - 1]);
    return gone;
  });
  wrong = std::move(kept);
}

struct Piece {
  double area = 0;
  int whole = 0;  ///< the piece of the uncut mesh it comes from
  bool closed = true;
  int vertex = 0;
  BoundingBox box{Vec3::Constant(std::numeric_limits<double>::infinity()),
                  Vec3::Constant(-std::numeric_limits<double>::infinity())};
};

std::vector<Piece> pieces_of(const Mesh& mesh, const Components& parts, const std::vector<int>& whole) {
  std::vector<Piece> pieces(at(parts.count));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Piece& piece = pieces[at(parts.of_triangle[t])];
    piece.area += area_vector(mesh, mesh.triangles[t]).norm();
    piece.whole = whole[t];
    piece.vertex = mesh.triangles[t][0];
    for (const int v : mesh.triangles[t]) {
      piece.box.low = piece.box.low.cwiseMin(mesh.vertices[at(v)]);
      piece.box.high = piece.box.high.cwiseMax(mesh.vertices[at(v)]);
    }
  }
  for (const MeshEdge& e : mesh_edges(mesh))
    if (e.count == 1) pieces[at(parts.of_triangle[at(e.t[0])])].closed = false;
  return pieces;
}

/// Does a closed piece hold another one? Only what its box holds is asked for.
bool is_inner(const Mesh& mesh, const Components& parts, const std::vector<Piece>& pieces, int k) {
  for (int outer = 0; outer < parts.count; ++outer) {
    const Piece &a = pieces[at(k)], &b = pieces[at(outer)];
    if (outer == k || !b.closed || b.area <= a.area) continue;
    if ((a.box.low.array() < b.box.low.array()).any() || (a.box.high.array() > b.box.high.array()).any()) continue;
    Mesh shell{mesh.vertices, {}};
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      if (parts.of_triangle[t] == outer) shell.triangles.push_back(mesh.triangles[t]);
    if (std::abs(WindingNumber(shell)(mesh.vertices[at(a.vertex)])) > 0.5) return true;
  }
  return false;
}

/// Takes out scraps, fins that hung on wrong triangles, and what lies inside another piece.
void cut_out_pieces(Mesh& mesh, const std::vector<int>& whole, std::vector<Flaw>& flaws) {
  const Components parts = connected_components(mesh);
  if (parts.count < 2) return;
  const std::vector<Piece> pieces = pieces_of(mesh, parts, whole);
  double most = 0;
  std::vector<double> largest(1 + at(*std::max_element(whole.begin(), whole.end())), 0.0);
  for (const Piece& p : pieces) {
    most = std::max(most, p.area);
    largest[at(p.whole)] = std::max(largest[at(p.whole)], p.area);
  }
  constexpr char kStray = 1, kInner = 2;
  std::vector<char> verdict(pieces.size(), 0);
  for (int k = 0; k < parts.count; ++k) {
    const Piece& p = pieces[at(k)];
    if (p.area < kScrapShare * most || p.area < kFinShare * largest[at(p.whole)]) verdict[at(k)] = kStray;
    if (p.closed && is_inner(mesh, parts, pieces, k)) verdict[at(k)] = kInner;
  }
  std::vector<char> wrong(mesh.triangles.size());
  for (std::size_t t = 0; t < wrong.size(); ++t) wrong[t] = verdict[at(parts.of_triangle[t])];
  add_places(mesh, wrong, kStray, Flaw::Kind::stray_piece, flaws);
  add_places(mesh, wrong, kInner, Flaw::Kind::inner_piece, flaws);
  remove_marked(mesh, wrong, kStray);
  remove_marked(mesh, wrong, kInner);
}

/// Points on the rim and on spokes to its middle: they stand for the piece of surface that is missing.
Flaw hole_flaw(const Mesh& mesh, const FreeLoop& loop) {
  Flaw flaw;
  flaw.kind = Flaw::Kind::hole;
  flaw.count = loop.vertices.size();
  Vec3 middle = Vec3::Zero();
  for (const int v : loop.vertices) middle += mesh.vertices[at(v)] / static_cast<double>(loop.vertices.size());
  const double edge = loop.length / static_cast<double>(loop.vertices.size());
  const std::size_t step = 1 + loop.vertices.size() / kMaxSpokes;
  for (std::size_t k = 0; k < loop.vertices.size(); ++k) {
    const Vec3& rim = mesh.vertices[at(loop.vertices[k])];
    flaw.points.push_back(rim);
    if (k % step != 0) continue;
    const int parts = std::clamp(static_cast<int>((rim - middle).norm() / edge), 1, 20);
    for (int i = 1; i < parts; ++i) flaw.points.push_back(rim + (middle - rim) * i / parts);
  }
  flaw.points.push_back(middle);
  return flaw;
}

/// The loops that were free before anything was taken out, and are no borders: of the rest, the flaws tell.
void add_holes(const Mesh& mesh, const std::vector<MeshEdge>& before, std::vector<Flaw>& flaws) {
  std::vector<std::array<int, 2>> free;  // sorted, as the edges are
  for (const MeshEdge& e : before)
    if (e.count == 1) free.push_back(e.v);
  if (free.empty()) return;
  for (const FreeLoop& loop : free_loops(mesh)) {
    bool was_free = false;
    for (std::size_t k = 0; k < loop.vertices.size() && !was_free; ++k) {
      const int a = loop.vertices[k], b = loop.vertices[(k + 1) % loop.vertices.size()];
      was_free = std::binary_search(free.begin(), free.end(), std::array{std::min(a, b), std::max(a, b)});
    }
    if (was_free && !loop.border) flaws.push_back(hole_flaw(mesh, loop));
  }
}

/// The triangles round a vertex that stands out so steeply that their angles there add up to little. Where its
/// neighbours do as well, the mesh is coarse there and no vertex is to blame; where creases meet, it is the corner of a
/// solid (SharpCorners).
void mark_spikes(const Mesh& mesh, const std::vector<MeshEdge>& edges, std::vector<char>& wrong, char mark) {
  std::vector<double> angle(mesh.vertices.size(), 0.0);
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = mesh.vertices[at(t[k])];
      const Vec3 u = mesh.vertices[at(t[(k + 1) % 3])] - p, v = mesh.vertices[at(t[(k + 2) % 3])] - p;
      angle[at(t[k])] += std::atan2(u.cross(v).norm(), u.dot(v));
    }
  std::vector<char> steep(mesh.vertices.size(), 0);
  for (std::size_t v = 0; v < angle.size(); ++v) steep[v] = angle[v] < kSteepFan;
  for (const MeshEdge& e : edges)
    if (e.count != 2) steep[at(e.v[0])] = steep[at(e.v[1])] = 0;
  const std::vector<char> alone = [&] {
    std::vector<char> out = steep;
    for (const MeshEdge& e : edges)
      if (steep[at(e.v[0])] != 0 && steep[at(e.v[1])] != 0) out[at(e.v[0])] = out[at(e.v[1])] = 0;
    return out;
  }();
  if (std::none_of(alone.begin(), alone.end(), [](char c) { return c != 0; })) return;
  const SharpCorners corners(mesh, edges);
  for (std::size_t t = 0; t < wrong.size(); ++t)
    for (const int v : mesh.triangles[t])
      if (alone[at(v)] != 0 && !corners.is_corner(v)) wrong[t] = mark;
}

}  // namespace

const char* to_string(Flaw::Kind kind) {
  switch (kind) {
    case Flaw::Kind::non_manifold:
      return "triangles on an edge of more than two";
    case Flaw::Kind::unorientable:
      return "triangles where no winding agrees";
    case Flaw::Kind::crossing:
      return "triangles that run through each other";
    case Flaw::Kind::spike:
      return "triangles of a spike";
    case Flaw::Kind::hole:
      return "hole";
    case Flaw::Kind::stray_piece:
      return "stray piece";
    case Flaw::Kind::inner_piece:
      return "piece inside another one";
  }
  return "";
}

std::vector<FreeLoop> free_loops(const Mesh& mesh) {
  const std::vector<MeshEdge> edges = mesh_edges(mesh);
  const Components parts = connected_components(mesh);
  std::vector<double> area(at(parts.count), 0.0), longest(at(parts.count), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    area[at(parts.of_triangle[t])] += area_vector(mesh, mesh.triangles[t]).norm();
  std::vector<int> triangle(mesh.vertices.size(), -1);  // one beside a free edge, for its piece
  for (const MeshEdge& e : edges)
    if (e.count == 1) triangle[at(e.v[0])] = triangle[at(e.v[1])] = e.t[0];
  const std::vector<Vec3> normals = vertex_normals(mesh);
  std::vector<FreeLoop> loops;
  std::vector<int> piece;
  std::vector<bool> tube;
  for (std::vector<int>& vertices : boundary_loops(mesh, edges)) {
    FreeLoop loop;
    Vec3 enclosed = Vec3::Zero();
    const Vec3& origin = mesh.vertices[at(vertices[0])];
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const Vec3 &p = mesh.vertices[at(vertices[k])], &q = mesh.vertices[at(vertices[(k + 1) % vertices.size()])];
      loop.length += (q - p).norm();
      enclosed += 0.5 * (p - origin).cross(q - origin);
    }
    double aligned = 0;
    for (const int v : vertices) aligned += std::abs(normals[at(v)].dot(enclosed.normalized()));
    tube.push_back(vertices.size() >= kMinTubeVertices && aligned < kTubeCosine * static_cast<double>(vertices.size()));
    piece.push_back(parts.of_triangle[at(triangle[at(vertices[0])])]);
    longest[at(piece.back())] = std::max(longest[at(piece.back())], loop.length);
    loop.vertices = std::move(vertices);
    loops.push_back(std::move(loop));
  }
  for (std::size_t k = 0; k < loops.size(); ++k) {
    const bool rim = loops[k].length >= longest[at(piece[k])] &&
                     loops[k].length > kLongLoopShare * std::sqrt(4 * M_PI * area[at(piece[k])]);
    loops[k].border = rim || tube[k];
  }
  return loops;
}

std::vector<Flaw> cut_out_flaws(Mesh& mesh) {
  std::vector<Flaw> flaws;
  if (mesh.empty()) return flaws;
  const std::vector<MeshEdge> edges = mesh_edges(mesh);
  constexpr char kNonManifold = 1, kUnorientable = 2, kCrossing = 3, kSpike = 4;
  std::vector<char> wrong(mesh.triangles.size(), 0);
  mark_spikes(mesh, edges, wrong, kSpike);
  for (const auto& [i, j] : crossing_triangles(mesh)) wrong[at(i)] = wrong[at(j)] = kCrossing;
  mark_non_manifold(mesh, edges, wrong, kNonManifold);
  mark_unorientable(mesh, edges, wrong, kUnorientable);
  add_places(mesh, wrong, kNonManifold, Flaw::Kind::non_manifold, flaws);
  add_places(mesh, wrong, kUnorientable, Flaw::Kind::unorientable, flaws);
  add_places(mesh, wrong, kCrossing, Flaw::Kind::crossing, flaws);
  add_places(mesh, wrong, kSpike, Flaw::Kind::spike, flaws);
  std::vector<int> whole = connected_components(mesh).of_triangle;
  std::size_t index = 0;
  std::erase_if(whole, [&](int) { return wrong[index++] != 0; });
  for (const char mark : {kNonManifold, kUnorientable, kCrossing, kSpike}) remove_marked(mesh, wrong, mark);
  if (!mesh.empty()) cut_out_pieces(mesh, whole, flaws);
  add_holes(mesh, edges, flaws);
  for (Flaw& flaw : flaws) set_ball(flaw);
  std::stable_sort(flaws.begin(), flaws.end(),
                   [](const Flaw& x, const Flaw& y) { return x.kind != y.kind ? x.kind < y.kind : x.count > y.count; });
  return flaws;
}

std::string describe(const Flaw& flaw, double metres_per_unit) {
  const Vec3 p = flaw.centre / metres_per_unit;
  const char* unit = length_unit_name(metres_per_unit);
  const std::string size = fmt::format("{:.3g} {}", 2 * flaw.radius / metres_per_unit, unit);
  const std::string where = fmt::format("near ({:.5g}, {:.5g}, {:.5g}) {}", p.x(), p.y(), p.z(), unit);
  switch (flaw.kind) {
    case Flaw::Kind::hole:
      return fmt::format("a hole of {} free edges, {} across, {}", flaw.count, size, where);
    case Flaw::Kind::stray_piece:
    case Flaw::Kind::inner_piece:
      return fmt::format("a {} of {} triangles, {} across, {}", to_string(flaw.kind), flaw.count, size, where);
    default:
      return fmt::format("{} {}, {} across, {}", flaw.count, to_string(flaw.kind), size, where);
  }
}

}  // namespace genu
