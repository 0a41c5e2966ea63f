#include "genu/mesh/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Geometry>

namespace genu {
namespace {

// One side of one triangle, with its ends in order.
struct HalfEdge {
  int low, high, triangle;
};

// Sorted by (low, high, triangle): two counting sorts, stable, so the triangles stay in their order.
std::vector<HalfEdge> sorted_half_edges(const Mesh& mesh) {
  std::vector<HalfEdge> edges, sorted;
  edges.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles[t][at(k)], b = mesh.triangles[t][at((k + 1) % 3)];
      edges.push_back({std::min(a, b), std::max(a, b), static_cast<int>(t)});
    }
  }
  sorted.resize(edges.size());
  std::vector<std::size_t> start;
  for (int HalfEdge::*key : {&HalfEdge::high, &HalfEdge::low}) {
    start.assign(mesh.vertices.size() + 1, 0);
    for (const HalfEdge& e : edges) ++start[at(e.*key) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    for (const HalfEdge& e : edges) sorted[start[at(e.*key)]++] = e;
    edges.swap(sorted);
  }
  return edges;
}

// +1 where the triangle runs from a to b, -1 where it runs from b to a.
int direction(const std::array<int, 3>& t, int a, int b) {
  for (int k = 0; k < 3; ++k) {
    if (t[at(k)] == a && t[at((k + 1) % 3)] == b) return 1;
  }
  return -1;
}

// For every triangle its manifold neighbours: the edges numbered (3 t + k), -1 where there is none.
std::vector<std::array<int, 3>> triangle_edges(const Mesh& mesh, const std::vector<MeshEdge>& edges) {
  std::vector<std::array<int, 3>> sides(mesh.triangles.size(), {-1, -1, -1});
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].count != 2) continue;
    for (const int t : edges[e].t) {
      auto& s = sides[at(t)];
      *std::find(s.begin(), s.end() - 1, -1) = static_cast<int>(e);
    }
  }
  return sides;
}

}  // namespace

std::vector<MeshEdge> mesh_edges(const Mesh& mesh) {
  std::vector<MeshEdge> edges;
  edges.reserve(mesh.triangles.size() * 3 / 2 + 1);
  for (const HalfEdge& h : sorted_half_edges(mesh)) {
    if (edges.empty() || edges.back().v[0] != h.low || edges.back().v[1] != h.high) {
      edges.push_back({.v = {h.low, h.high}});
    }
    MeshEdge& e = edges.back();
    if (e.count < 2) e.t[at(e.count)] = h.triangle;
    ++e.count;
  }
  return edges;
}

VertexNeighbours vertex_neighbours(const Mesh& mesh, const std::vector<MeshEdge>& edges) {
  VertexNeighbours n;
  n.offset.assign(mesh.vertices.size() + 1, 0);
  for (const MeshEdge& e : edges) {
    ++n.offset[at(e.v[0]) + 1];
    ++n.offset[at(e.v[1]) + 1];
  }
  std::partial_sum(n.offset.begin(), n.offset.end(), n.offset.begin());
  n.neighbours.resize(2 * edges.size());
  std::vector<int> next(n.offset.begin(), n.offset.end() - 1);
  // Edges are sorted: first every smaller neighbour in its order, then every larger one.
  for (const MeshEdge& e : edges) n.neighbours[at(next[at(e.v[1])]++)] = e.v[0];
  for (const MeshEdge& e : edges) n.neighbours[at(next[at(e.v[0])]++)] = e.v[1];
  return n;
}

std::vector<bool> boundary_vertices(const Mesh& mesh, const std::vector<MeshEdge>& edges) {
  std::vector<bool> on(mesh.vertices.size(), false);
  for (const MeshEdge& e : edges) {
    if (e.count == 1) on[at(e.v[0])] = on[at(e.v[1])] = true;
  }
  return on;
}

std::vector<std::vector<int>> boundary_loops(const Mesh& mesh, const std::vector<MeshEdge>& edges) {
  std::vector<std::array<int, 2>> sides;  // from, to
  for (const MeshEdge& e : edges) {
    if (e.count != 1) continue;
    const bool forward = direction(mesh.triangles[at(e.t[0])], e.v[0], e.v[1]) > 0;
    sides.push_back(forward ? e.v : std::array<int, 2>{e.v[1], e.v[0]});
  }
  std::sort(sides.begin(), sides.end());
  std::vector<bool> walked(sides.size(), false);
  std::vector<std::vector<int>> loops;
  for (std::size_t first = 0; first < sides.size(); ++first) {
    if (walked[first]) continue;
    std::vector<int> loop;
    for (std::size_t i = first;;) {
      walked[i] = true;
      loop.push_back(sides[i][0]);
      auto next = std::lower_bound(sides.begin(), sides.end(), std::array<int, 2>{sides[i][1], -1});
      while (next != sides.end() && (*next)[0] == sides[i][1] &&
             walked[static_cast<std::size_t>(next - sides.begin())]) {
        ++next;
      }
      if (next == sides.end() || (*next)[0] != sides[i][1]) break;
      i = static_cast<std::size_t>(next - sides.begin());
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

Components connected_components(const Mesh& mesh) {
  std::vector<int> parent(mesh.triangles.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int t) {
    while (parent[at(t)] != t) t = parent[at(t)] = parent[at(parent[at(t)])];
    return t;
  };
  const std::vector<HalfEdge> sides = sorted_half_edges(mesh);
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i].low != sides[i - 1].low || sides[i].high != sides[i - 1].high) continue;
    const int a = root(sides[i - 1].triangle), b = root(sides[i].triangle);
    parent[at(std::max(a, b))] = std::min(a, b);
  }
  Components c;
  c.of_triangle.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const int r = root(static_cast<int>(t));  // never larger than t, so already numbered unless it is t
    c.of_triangle[t] = r == static_cast<int>(t) ? c.count++ : c.of_triangle[at(r)];
  }
  return c;
}

WindingReport make_winding_consistent(Mesh& mesh, const std::vector<MeshEdge>& edges) {
  const std::vector<std::array<int, 3>> sides = triangle_edges(mesh, edges);
  std::vector<int> turn(mesh.triangles.size(), 0);  // +1 as the first triangle of the flood, -1 against it
  WindingReport report;
  std::vector<int> flood;
  for (std::size_t first = 0; first < mesh.triangles.size(); ++first) {
    if (turn[first] != 0) continue;
    turn[first] = 1;
    flood.assign(1, static_cast<int>(first));
    std::size_t against = 0;
    for (std::size_t head = 0; head < flood.size(); ++head) {
      const int t = flood[head];
      for (const int side : sides[at(t)]) {
        if (side < 0) continue;
        const MeshEdge& e = edges[at(side)];
        const int other = e.t[0] == t ? e.t[1] : e.t[0];
        const bool agree =
            direction(mesh.triangles[at(t)], e.v[0], e.v[1]) != direction(mesh.triangles[at(other)], e.v[0], e.v[1]);
        const int wanted = agree ? turn[at(t)] : -turn[at(t)];
        if (turn[at(other)] == 0) {
          turn[at(other)] = wanted;
          against += wanted < 0 ? 1 : 0;
          flood.push_back(other);
        } else if (turn[at(other)] != wanted) {
          report.orientable = false;
        }
      }
    }
    const int minority = 2 * against > flood.size() ? 1 : -1;
    for (const int t : flood) {
      if (turn[at(t)] != minority) continue;
      std::swap(mesh.triangles[at(t)][1], mesh.triangles[at(t)][2]);
      ++report.flipped;
    }
  }
  return report;
}

std::vector<Vec3> vertex_normals(const Mesh& mesh) {
  std::vector<Vec3> normals(mesh.vertices.size(), Vec3::Zero());
  for (const auto& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Vec3& p = mesh.vertices[at(t[at(k)])];
      const Vec3 a = mesh.vertices[at(t[at((k + 1) % 3)])] - p, b = mesh.vertices[at(t[at((k + 2) % 3)])] - p;
      const Vec3 area = a.cross(b);
      const double twice = area.norm();
      if (twice > 0) normals[at(t[at(k)])] += std::atan2(twice, a.dot(b)) / twice * area;
    }
  }
  for (Vec3& n : normals) {
    const double length = n.norm();
    if (length > 0) n /= length;
  }
  return normals;
}

double median_edge_length(const Mesh& mesh, const std::vector<MeshEdge>& edges) {
  if (edges.empty()) return 0;
  std::vector<double> lengths;
  lengths.reserve(edges.size());
  for (const MeshEdge& e : edges) lengths.push_back((mesh.vertices[at(e.v[1])] - mesh.vertices[at(e.v[0])]).norm());
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

BoundingBox bounding_box(const Mesh& mesh) {
  if (mesh.vertices.empty()) return {};
  BoundingBox box{mesh.vertices.front(), mesh.vertices.front()};
  for (const Vec3& v : mesh.vertices) {
    box.low = box.low.cwiseMin(v);
    box.high = box.high.cwiseMax(v);
  }
  return box;
}

}  // namespace genu
