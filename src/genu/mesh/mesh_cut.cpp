#include "genu/mesh/mesh_cut.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "genu/mesh/mesh_topology.h"
#include "genu/mesh/tolerances.h"

namespace genu {
namespace {

class Cut {
 public:
  Cut(const Mesh& mesh, const std::function<double(const Vec3&)>& inside,
      const std::function<Vec3(const Vec3&, const Vec3&)>& crossing)
      : mesh_(mesh), kept_(mesh.vertices.size(), -1) {
    for (const Vec3& v : mesh.vertices) side_.push_back(inside(v) >= 0 ? Side::in : Side::out);
    const std::vector<Side> original = side_;
    moved_ = mesh.vertices;
    const std::vector<MeshEdge> edges = mesh_edges(mesh);
    const std::vector<bool> border = boundary_vertices(mesh, edges);
    for (const MeshEdge& e : edges) {
      const int a = original[at(e.v[0])] == Side::in ? e.v[0] : e.v[1], b = e.v[0] + e.v[1] - a;
      if (original[at(a)] == original[at(b)]) continue;
      const Vec3 p = crossing(mesh.vertices[at(a)], mesh.vertices[at(b)]);
      crossings_[{a, b}] = {p, -1};
      const double share = (p - mesh.vertices[at(a)]).norm() / (mesh.vertices[at(b)] - mesh.vertices[at(a)]).norm();
      // A vertex of the border stays on it.
      if (share < kCutSnapShare && (!border[at(a)] || e.count == 1)) move(a, p);
      if (share > 1 - kCutSnapShare && (!border[at(b)] || e.count == 1)) move(b, p);
    }
  }

  Mesh run() {
    for (const auto& t : mesh_.triangles) add(t);
    return std::move(out_);
  }

 private:
  enum class Side { in, on, out };
  struct Crossing {
    Vec3 p;
    int index;  ///< in out_, -1 where not used yet
  };

  void move(int v, const Vec3& p) {
    if (side_[at(v)] == Side::on) return;
    side_[at(v)] = Side::on;
    moved_[at(v)] = p;
  }

  int append(const Vec3& p) {
    out_.vertices.push_back(p);
    return static_cast<int>(out_.vertices.size()) - 1;
  }

  int keep(int v) {
    if (kept_[at(v)] < 0) kept_[at(v)] = append(moved_[at(v)]);
    return kept_[at(v)];
  }

  int cross(int in, int outside) {
    Crossing& c = crossings_.at({in, outside});
    if (c.index < 0) c.index = append(c.p);
    return c.index;
  }

  /// The polygon that is left of a triangle, of 3 or 4 corners in its winding, as a fan.
  void add(const std::array<int, 3>& t) {
    if (std::none_of(t.begin(), t.end(), [&](int v) { return side_[at(v)] == Side::in; })) return;
    std::array<int, 4> corners{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      const Side from = side_[at(a)], to = side_[at(b)];
      if (from != Side::out) corners[count++] = keep(a);
      if (from == Side::in && to == Side::out) corners[count++] = cross(a, b);
      if (from == Side::out && to == Side::in) corners[count++] = cross(b, a);
    }
    for (std::size_t k = 2; k < count; ++k) out_.triangles.push_back({corners[0], corners[k - 1], corners[k]});
  }

  const Mesh& mesh_;
  std::vector<Side> side_;
  std::vector<Vec3> moved_;                            // the vertices, those on the cut where they were moved to
  std::vector<int> kept_;                              // index in out_ of each vertex, -1 where not used yet
  std::map<std::pair<int, int>, Crossing> crossings_;  // of edges (inside, outside)
  Mesh out_;
};

}  // namespace

Mesh cut_mesh(const Mesh& mesh, const std::function<double(const Vec3&)>& inside,
              const std::function<Vec3(const Vec3& a, const Vec3& b)>& crossing) {
  return Cut(mesh, inside, crossing).run();
}

}  // namespace genu
