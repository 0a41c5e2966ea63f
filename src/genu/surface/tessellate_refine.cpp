// refine(): isotropic remeshing by splitting, flipping and relaxing.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <Eigen/Geometry>

#include "genu/mesh/mesh_part.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/surface/tessellate.h"
#include "genu/surface/tolerances.h"

namespace genu {
namespace {

// The corner of t that is neither end of the edge.
int opposite(const std::array<int, 3>& t, const MeshEdge& e) { return t[0] + t[1] + t[2] - e.v[0] - e.v[1]; }

class Refinement {
 public:
  Refinement(Mesh& mesh, const Surface& surface, double edge)
      : mesh_(mesh), surface_(surface), edge_(affordable_edge(edge, area_of(mesh))) {
    for (const Vec3& v : mesh.vertices) wanted_.push_back(wanted(v));
  }

  void run() {
    bool changed = false;
    for (int pass = 0; pass < kMaxRefinePasses && split(); ++pass) {
      changed = true;
      flip();
      relax();
    }
    if (!changed) return;
    for (int pass = 0; pass < kRelaxations; ++pass) {
      relax();
      flip();
    }
  }

 private:
  double wanted(const Vec3& p) const {
    SurfacePoint s;
    if (!surface_.project(p, s)) return edge_;
    const double mean = 0.5 * s.S.trace(), half = std::hypot(0.5 * (s.S(0, 0) - s.S(1, 1)), s.S(0, 1));
    const double curvature = std::abs(mean) + half;
    return curvature > 0 ? graded_edge(edge_, 1 / curvature) : edge_;
  }

  double length_ratio(const MeshEdge& e) const {
    const double length = (mesh_.vertices[at(e.v[1])] - mesh_.vertices[at(e.v[0])]).norm();
    return length / (0.5 * (wanted_[at(e.v[0])] + wanted_[at(e.v[1])]));
  }

  // Splits the longest edges first, no triangle twice in a pass. False when no edge is too long.
  bool split() {
    if (static_cast<double>(mesh_.triangles.size()) >= kMaxTriangles) return false;
    const std::vector<MeshEdge> edges = mesh_edges(mesh_);
    std::vector<std::pair<double, std::size_t>> longest;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const double ratio = length_ratio(edges[e]);
      if (ratio > kSplitRatio && edges[e].count <= 2) longest.emplace_back(-ratio, e);
    }
    std::sort(longest.begin(), longest.end());
    std::vector<bool> touched(mesh_.triangles.size(), false);
    bool any = false;
    for (const auto& [ratio, index] : longest) {
      if (static_cast<double>(mesh_.triangles.size()) >= kMaxTriangles) break;
      const MeshEdge& e = edges[index];
      if (touched[at(e.t[0])] || (e.t[1] >= 0 && touched[at(e.t[1])])) continue;
      SurfacePoint middle;
      if (!surface_.project(0.5 * (mesh_.vertices[at(e.v[0])] + mesh_.vertices[at(e.v[1])]), middle)) continue;
      const int m = static_cast<int>(mesh_.vertices.size());
      mesh_.vertices.push_back(middle.p);
      wanted_.push_back(wanted(middle.p));
      for (const int t : e.t) {
        if (t < 0) continue;
        touched[at(t)] = true;
        auto second = mesh_.triangles[at(t)];
        std::replace(mesh_.triangles[at(t)].begin(), mesh_.triangles[at(t)].end(), e.v[1], m);
        std::replace(second.begin(), second.end(), e.v[0], m);
        mesh_.triangles.push_back(second);
      }
      any = true;
    }
    return any;
  }

  double angle(int corner, int a, int b) const {
    const Vec3 u = mesh_.vertices[at(a)] - mesh_.vertices[at(corner)];
    const Vec3 v = mesh_.vertices[at(b)] - mesh_.vertices[at(corner)];
    return std::atan2(u.cross(v).norm(), u.dot(v));
  }

  // Delaunay: flips where the angles opposite to an edge add up to more than pi.
  void flip() {
    const std::vector<MeshEdge> edges = mesh_edges(mesh_);
    std::vector<bool> touched(mesh_.triangles.size(), false);
    std::set<std::array<int, 2>> made;
    for (const MeshEdge& e : edges) {
      if (e.count != 2 || touched[at(e.t[0])] || touched[at(e.t[1])]) continue;
      auto &t0 = mesh_.triangles[at(e.t[0])], &t1 = mesh_.triangles[at(e.t[1])];
      const int c = opposite(t0, e), d = opposite(t1, e);
      if (angle(c, e.v[0], e.v[1]) + angle(d, e.v[0], e.v[1]) <= std::numbers::pi * (1 + 1e-9)) continue;
      const std::array<int, 2> crossing{std::min(c, d), std::max(c, d)};
      const auto same = std::lower_bound(edges.begin(), edges.end(), crossing,
                                         [](const MeshEdge& x, const std::array<int, 2>& v) { return x.v < v; });
      if (same != edges.end() && same->v == crossing) continue;
      if (!made.insert(crossing).second) continue;
      // t0 keeps v[0] and takes d in place of v[1]; t1 keeps v[1] and takes c in place of v[0]: windings stay.
      std::replace(t0.begin(), t0.end(), e.v[1], d);
      std::replace(t1.begin(), t1.end(), e.v[0], c);
      touched[at(e.t[0])] = touched[at(e.t[1])] = true;
    }
  }

  // Moves inner vertices to the mean of their triangles' centres, weighted by area, along the surface.
  void relax() {
    const std::vector<bool> fixed = boundary_vertices(mesh_, mesh_edges(mesh_));
    std::vector<Vec3> sum(mesh_.vertices.size(), Vec3::Zero());
    std::vector<double> weight(mesh_.vertices.size(), 0.0);
    for (const auto& t : mesh_.triangles) {
      const Vec3 &a = mesh_.vertices[at(t[0])], &b = mesh_.vertices[at(t[1])], &c = mesh_.vertices[at(t[2])];
      const double local = (wanted_[at(t[0])] + wanted_[at(t[1])] + wanted_[at(t[2])]) / 3;
      // Area in wanted triangles: where edges shall be short, triangles pull as hard as large ones elsewhere.
      const double area = (b - a).cross(c - a).norm() / (local * local);
      for (const int v : t) {
        sum[at(v)] += area / 3 * (a + b + c);
        weight[at(v)] += area;
      }
    }
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      SurfacePoint moved;
      if (fixed[v] || !(weight[v] > 0) || !surface_.project(sum[v] / weight[v], moved)) continue;
      mesh_.vertices[v] = moved.p;
      wanted_[v] = wanted(moved.p);
    }
  }

  Mesh& mesh_;
  const Surface& surface_;
  double edge_;
  std::vector<double> wanted_;  ///< edge length wanted at each vertex, m
};

}  // namespace

void refine(Mesh& mesh, const Surface& surface, double edge) { Refinement(mesh, surface, edge).run(); }

}  // namespace genu
