#include "genu/mesh/mesh_coarsen.h"

#include <algorithm>
#include <queue>
#include <tuple>

#include <Eigen/Geometry>

#include "genu/mesh/mesh_topology.h"
#include "genu/mesh/tolerances.h"

namespace genu {
namespace {

class Coarsening {
 public:
  explicit Coarsening(const Mesh& mesh) : mesh_(mesh), beside_(mesh.vertices.size()) {
    const std::vector<MeshEdge> edges = mesh_edges(mesh);
    boundary_ = boundary_vertices(mesh, edges);
    fixed_.assign(mesh.vertices.size(), false);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (const int v : mesh.triangles[t]) beside_[at(v)].push_back(static_cast<int>(t));
    for (const MeshEdge& e : edges) {
      if (e.count > 2)
        for (const int v : e.v) fixed_[at(v)] = true;
      add(e.v[0], e.v[1]);
    }
    used_ = static_cast<std::size_t>(
        std::count_if(beside_.begin(), beside_.end(), [](const auto& triangles) { return !triangles.empty(); }));
  }

  void run(double factor) {
    const auto wanted = static_cast<std::size_t>(static_cast<double>(used_) / (factor * factor));
    while (used_ > wanted && !shortest_.empty()) {
      const auto [length, a, b] = shortest_.top();
      shortest_.pop();
      if (beside_[at(a)].empty() || beside_[at(b)].empty() || !joined(a, b)) continue;
      // Either end may go; the one that comes later is tried first, an inner one before one of the boundary.
      if (draw(b, a) || draw(a, b)) --used_;
    }
  }

  Mesh result() const {
    Mesh out;
    std::vector<int> index(mesh_.vertices.size(), -1);
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      if (beside_[v].empty()) continue;
      index[v] = static_cast<int>(out.vertices.size());
      out.vertices.push_back(mesh_.vertices[v]);
    }
    for (const auto& t : mesh_.triangles)
      if (t[0] != t[1]) out.triangles.push_back({index[at(t[0])], index[at(t[1])], index[at(t[2])]});
    return out;
  }

 private:
  using Edge = std::tuple<double, int, int>;

  void add(int a, int b) {
    const double length = (mesh_.vertices[at(a)] - mesh_.vertices[at(b)]).norm();
    shortest_.emplace(length, std::min(a, b), std::max(a, b));
  }

  static bool has(const std::array<int, 3>& t, int v) { return t[0] == v || t[1] == v || t[2] == v; }

  bool joined(int a, int b) const {
    return std::any_of(beside_[at(a)].begin(), beside_[at(a)].end(),
                       [&](int t) { return has(mesh_.triangles[at(t)], b); });
  }

  void neighbours(int v, std::vector<int>& out) const {
    out.clear();
    for (const int t : beside_[at(v)])
      for (const int w : mesh_.triangles[at(t)])
        if (w != v) out.push_back(w);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
  }

  bool keeps_the_sheet(int gone, int kept) {
    const auto shared = static_cast<std::size_t>(std::count_if(
        beside_[at(gone)].begin(), beside_[at(gone)].end(), [&](int t) { return has(mesh_.triangles[at(t)], kept); }));
    if (boundary_[at(gone)] && (!boundary_[at(kept)] || shared != 1)) return false;
    neighbours(gone, around_gone_);
    neighbours(kept, around_kept_);
    common_.clear();
    std::set_intersection(around_gone_.begin(), around_gone_.end(), around_kept_.begin(), around_kept_.end(),
                          std::back_inserter(common_));
    constexpr std::size_t kLeastRing = 3;  // of a vertex: a tetrahedron stays one
    return common_.size() == shared && around_kept_.size() + around_gone_.size() - common_.size() - 2 >= kLeastRing;
  }

  bool keeps_the_shape(int gone, int kept) const {
    for (const int t : beside_[at(gone)]) {
      std::array<int, 3> corners = mesh_.triangles[at(t)];
      if (has(corners, kept)) continue;
      const Vec3 before = normal(corners);
      std::replace(corners.begin(), corners.end(), gone, kept);
      const Vec3 after = normal(corners);
      if (!(before.dot(after) >= kCoarsenMinCosine * before.norm() * after.norm()) || after.norm() == 0) return false;
    }
    return true;
  }

  Vec3 normal(const std::array<int, 3>& t) const {
    const Vec3 &a = mesh_.vertices[at(t[0])], &b = mesh_.vertices[at(t[1])], &c = mesh_.vertices[at(t[2])];
    return (b - a).cross(c - a);
  }

  bool draw(int gone, int kept) {
    if (fixed_[at(gone)] || !keeps_the_sheet(gone, kept) || !keeps_the_shape(gone, kept)) return false;
    for (const int t : beside_[at(gone)]) {
      auto& corners = mesh_.triangles[at(t)];
      if (has(corners, kept)) {
        for (const int v : corners)
          if (v != gone) std::erase(beside_[at(v)], t);
        corners = {0, 0, 0};
        continue;
      }
      std::replace(corners.begin(), corners.end(), gone, kept);
      beside_[at(kept)].push_back(t);
    }
    beside_[at(gone)].clear();
    neighbours(kept, around_kept_);
    for (const int v : around_kept_) add(kept, v);
    return true;
  }

  Mesh mesh_;
  std::vector<std::vector<int>> beside_;  // the triangles of each vertex
  std::vector<bool> boundary_, fixed_;
  std::priority_queue<Edge, std::vector<Edge>, std::greater<>> shortest_;
  std::vector<int> around_gone_, around_kept_, common_;
  std::size_t used_ = 0;
};

}  // namespace

Mesh coarsened(const Mesh& mesh, double factor) {
  Coarsening coarsening(mesh);
  coarsening.run(factor);
  return coarsening.result();
}

}  // namespace genu
