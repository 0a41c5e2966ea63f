#include "genu/mesh/boundary_edges.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Geometry>

namespace genu {

BoundaryEdges::BoundaryEdges(const Mesh& mesh, const VertexGraph& graph, double cap) : cap_(cap) {
  std::map<int, Vec3> at_vertex;
  std::vector<Vec3> middles;
  std::vector<double> reaches;
  std::vector<std::array<int, 2>> ends;
  for (const auto& [from, to, triangle] : graph.boundary) {
    const auto& t = mesh.triangles[triangle];
    const Vec3 &a = mesh.vertices[from], &b = mesh.vertices[to];
    const Vec3 twice = (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    const Vec3 outward = (b - a).cross(twice);
    if (!(outward.norm() > 0)) continue;
    const Edge edge{a, b, twice.normalized(), outward.normalized(), Vec3::Zero(), Vec3::Zero(), graph.component[from]};
    for (int v : {from, to}) at_vertex.try_emplace(v, Vec3::Zero()).first->second += edge.outward;
    ends.push_back({from, to});
    edges_.push_back(edge);
    middles.push_back(0.5 * (a + b));
    reaches.push_back(0.5 * (b - a).norm() + cap);
  }
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    edges_[e].outward_a = at_vertex[ends[e][0]];
    edges_[e].outward_b = at_vertex[ends[e][1]];
  }
  cells_ = CellLists(middles, reaches, 0.5 * cap);
}

double BoundaryEdges::signed_distance(const Vec3& p, int component) const {
  double least = cap_ * cap_, signed_distance = cap_;
  for (int e : cells_.at(p)) {
    const Edge& edge = edges_[e];
    if (edge.component != component) continue;
    const Vec3 along = edge.b - edge.a;
    const double s = std::clamp(along.dot(p - edge.a) / along.squaredNorm(), 0.0, 1.0);
    const Vec3 d = p - (edge.a + s * along);
    if (d.squaredNorm() >= least) continue;
    least = d.squaredNorm();
    const Vec3& outward = s <= 0 ? edge.outward_a : s >= 1 ? edge.outward_b : edge.outward;
    const double tangential = (d - d.dot(edge.normal) * edge.normal).norm();
    signed_distance = outward.dot(d) > 0 ? -tangential : tangential;
  }
  return signed_distance;
}

}  // namespace genu
