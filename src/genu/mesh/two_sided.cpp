#include "genu/mesh/two_sided.h"

#include "genu/mesh/mesh_topology.h"

namespace genu {
namespace {

using Triangle = std::array<int, 3>;

void turn(Triangle& t) { std::swap(t[1], t[2]); }

/// Whether t passes the edge from a to b.
bool passes(const Triangle& t, int a, int b) {
  return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
}

class Sides {
 public:
  Sides(Mesh& mesh, const std::vector<bool>& both_ways)
      : mesh_(mesh), both_ways_(both_ways), edges_(mesh_edges(mesh)), beside_(mesh.triangles.size()) {
    chosen_.assign(mesh.triangles.size(), false);
    open_.assign(mesh.triangles.size(), false);
    for (const MeshEdge& e : edges_)
      for (const int t : e.t) {
        if (t < 0) continue;
        if (e.count == 2)
          beside_[at(t)].push_back(&e);
        else
          open_[at(t)] = true;
      }
  }

  void choose() {
    std::vector<int> given;
    for (int t = 0; t < count(); ++t)
      if (!both_ways_[at(t)]) chosen_[at(t)] = true, given.push_back(t);
    spread(given);
    for (int t = 0; t < count(); ++t) {
      if (chosen_[at(t)]) continue;
      chosen_[at(t)] = true;
      face_outward(spread({t}));
    }
  }

 private:
  int count() const { return static_cast<int>(mesh_.triangles.size()); }

  /// From triangles whose side is chosen to all that hang together with them: returns these and those.
  std::vector<int> spread(std::vector<int> found) {
    for (std::size_t k = 0; k < found.size(); ++k)
      for (const MeshEdge* e : beside_[at(found[k])]) {
        const int other = e->t[0] == found[k] ? e->t[1] : e->t[0];
        if (chosen_[at(other)]) continue;
        chosen_[at(other)] = true;
        const auto& [a, b] = e->v;
        if (passes(mesh_.triangles[at(other)], a, b) == passes(mesh_.triangles[at(found[k])], a, b))
          turn(mesh_.triangles[at(other)]);
        found.push_back(other);
      }
    return found;
  }

  void face_outward(const std::vector<int>& piece) {
    const Vec3 origin = mesh_.vertices[at(mesh_.triangles[at(piece[0])][0])];
    double volume = 0;
    for (const int t : piece) {
      if (open_[at(t)]) return;
      const auto& [a, b, c] = mesh_.triangles[at(t)];
      volume +=
          (mesh_.vertices[at(a)] - origin).dot((mesh_.vertices[at(b)] - origin).cross(mesh_.vertices[at(c)] - origin));
    }
    if (volume < 0)
      for (const int t : piece) turn(mesh_.triangles[at(t)]);
  }

  Mesh& mesh_;
  const std::vector<bool>& both_ways_;
  std::vector<MeshEdge> edges_;
  std::vector<std::vector<const MeshEdge*>> beside_;  ///< for each triangle, its edges with one other triangle
  std::vector<bool> chosen_, open_;                   ///< open: it has another kind of edge
};

}  // namespace

void choose_sides(Mesh& mesh, const std::vector<bool>& both_ways) { Sides(mesh, both_ways).choose(); }

}  // namespace genu
