#include "genu/mesh_care/mesh_smooth.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "genu/mesh/mesh_topology.h"
#include "genu/mesh/vertex_graph.h"
#include "genu/mesh_care/tolerances.h"

namespace genu {
namespace {

/// m^3 within a closed mesh; 0 for an open one.
double closed_volume(const Mesh& mesh) {
  for (const MeshEdge& e : mesh_edges(mesh))
    if (e.count != 2) return 0;
  const Vec3 origin = bounding_box(mesh).low;
  double volume = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[at(t[0])] - origin, b = mesh.vertices[at(t[1])] - origin,
               c = mesh.vertices[at(t[2])] - origin;
    volume += a.dot(b.cross(c)) / 6;
  }
  return volume;
}

/// Which vertices each one is averaged with: all its neighbours, or on a free border those along it.
std::vector<std::vector<int>> partners(const Mesh& mesh, const VertexGraph& graph) {
  std::vector<std::vector<int>> out(mesh.vertices.size());
  for (const auto& edge : graph.boundary) {
    out[at(edge[0])].push_back(edge[1]);
    out[at(edge[1])].push_back(edge[0]);
  }
  for (std::size_t v = 0; v < out.size(); ++v) {
    if (!out[v].empty()) continue;
    const auto all = graph.neighbours(static_cast<int>(v));
    out[v].assign(all.begin(), all.end());
  }
  return out;
}

class Smoother {
 public:
  Smoother(Mesh& mesh, double bound)
      : mesh_(mesh),
        bound_(bound),
        start_(mesh.vertices),
        graph_(vertex_graph(mesh)),
        partners_(partners(mesh, graph_)) {}

  /// A share of the way to the mean of the partners, away from it where it is negative.
  void step(double share) {
    std::vector<Vec3> moved = mesh_.vertices;
    for (std::size_t v = 0; v < moved.size(); ++v) {
      if (partners_[v].empty()) continue;
      Vec3 mean = Vec3::Zero();
      for (const int w : partners_[v]) mean += mesh_.vertices[at(w)];
      moved[v] += share * (mean / static_cast<double>(partners_[v].size()) - moved[v]);
    }
    mesh_.vertices = std::move(moved);
  }

  /// Along the normals, as far as brings the volume back.
  void restore(double volume) {
    const VertexGraph graph = vertex_graph(mesh_);
    const double out = (volume - closed_volume(mesh_)) / graph.area;
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) mesh_.vertices[v] += out * graph.normals[v];
  }

  void hold(SmoothReport& report) {
    for (std::size_t v = 0; v < start_.size(); ++v) {
      Vec3 way = mesh_.vertices[v] - start_[v];
      if (way.norm() > bound_) {
        ++report.held;
        way *= bound_ / way.norm();
        mesh_.vertices[v] = start_[v] + way;
      }
      report.rms += way.squaredNorm();
      report.largest = std::max(report.largest, way.norm());
    }
    report.rms = std::sqrt(report.rms / static_cast<double>(std::max<std::size_t>(1, start_.size())));
  }

 private:
  Mesh& mesh_;
  double bound_;
  std::vector<Vec3> start_;
  VertexGraph graph_;
  std::vector<std::vector<int>> partners_;
};

}  // namespace

SmoothReport smooth_mesh(Mesh& mesh, double bound) {
  SmoothReport report;
  report.volume_before = closed_volume(mesh);
  Smoother smoother(mesh, bound);
  // Waves of this many edges have about this eigenvalue of the mean; slower ones stay.
  const double pass = 0.25 * std::pow(2 * std::numbers::pi / kSmoothedEdges, 2);
  const double grow = -1 / (1 / kSmoothStep - pass);
  const int rounds = static_cast<int>(std::ceil(kSmoothRounds / pass));
  for (int round = 0; round < rounds; ++round) {
    smoother.step(kSmoothStep);
    smoother.step(grow);
  }
  if (report.volume_before != 0) smoother.restore(report.volume_before);
  smoother.hold(report);
  report.volume_after = closed_volume(mesh);
  return report;
}

}  // namespace genu
