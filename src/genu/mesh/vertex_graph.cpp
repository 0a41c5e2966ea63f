#include "genu/mesh/vertex_graph.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace genu {
namespace {

void add_normals_and_areas(const Mesh& mesh, VertexGraph& graph) {
  graph.normals.assign(mesh.vertices.size(), Vec3::Zero());
  graph.areas.assign(mesh.vertices.size(), 0.0);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 twice = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    const double area = 0.5 * twice.norm();
    graph.area += area;
    for (int v : {a, b, c}) {
      graph.normals[v] += twice;
      graph.areas[v] += area / 3;
    }
  }
  for (Vec3& n : graph.normals) {
    const double length = n.norm();
    n = length > 0 ? Vec3(n / length) : Vec3::Zero();
  }
}

struct VertexSide {
  int to;
  int triangle;
  bool forward;  ///< runs from its vertex to `to` in the triangle's own order
};

void add_edges(const Mesh& mesh, VertexGraph& graph) {
  const int count = static_cast<int>(mesh.vertices.size());
  std::vector<int> start(count + 1, 0);
  for (const auto& t : mesh.triangles) {
    for (int v : t) start[v + 1] += 2;
  }
  for (int v = 0; v < count; ++v) start[v + 1] += start[v];
  std::vector<VertexSide> half(start[count]);
  std::vector<int> fill(start.begin(), start.end() - 1);
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
      half[fill[from]++] = {to, t, true};
      half[fill[to]++] = {from, t, false};
    }
  }
  std::vector<double> lengths;
  lengths.reserve(mesh.triangles.size() * 3 / 2 + 1);
  graph.first.assign(count + 1, 0);
  graph.adjacent.reserve(half.size() / 2);
  for (int v = 0; v < count; ++v) {
    const auto begin = half.begin() + start[v], end = half.begin() + start[v + 1];
    std::sort(begin, end, [](const VertexSide& a, const VertexSide& b) {
      return a.to != b.to ? a.to < b.to : a.triangle < b.triangle;
    });
    for (auto it = begin; it != end;) {
      auto next = it;
      while (next != end && next->to == it->to) ++next;
      if (it->to != v) {
        graph.adjacent.push_back(it->to);
        if (next - it == 1 && it->forward) graph.boundary.push_back({v, it->to, it->triangle});
        if (it->to > v) lengths.push_back((mesh.vertices[it->to] - mesh.vertices[v]).norm());
      }
      it = next;
    }
    graph.first[v + 1] = static_cast<int>(graph.adjacent.size());
  }
  if (lengths.empty()) return;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  graph.median_edge = *middle;
}

void add_components(VertexGraph& graph) {
  const int count = static_cast<int>(graph.normals.size());
  graph.component.assign(count, -1);
  int components = 0;
  std::vector<int> stack;
  for (int seed = 0; seed < count; ++seed) {
    if (graph.component[seed] >= 0 || graph.neighbours(seed).empty()) continue;
    graph.component[seed] = components;
    stack.push_back(seed);
    while (!stack.empty()) {
      const int v = stack.back();
      stack.pop_back();
      for (int w : graph.neighbours(v)) {
        if (graph.component[w] >= 0) continue;
        graph.component[w] = components;
        stack.push_back(w);
      }
    }
    ++components;
  }
}

}  // namespace

std::span<const int> VertexGraph::neighbours(int v) const {
  return {adjacent.data() + first[v], static_cast<std::size_t>(first[v + 1] - first[v])};
}

VertexGraph vertex_graph(const Mesh& mesh) {
  VertexGraph graph;
  add_normals_and_areas(mesh, graph);
  add_edges(mesh, graph);
  add_components(graph);
  return graph;
}

}  // namespace genu
