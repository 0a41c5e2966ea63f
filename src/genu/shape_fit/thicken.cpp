#include "genu/shape_fit/thicken.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "genu/mesh/mesh_topology.h"
#include "genu/shape_fit/tolerances.h"

namespace genu {
namespace {

int size_of(const Mesh& mesh) { return static_cast<int>(mesh.vertices.size()); }

/// Layers of vertices behind those of the border: number of vertex `v` in layer k, 0 the sheet, `layers` the copy.
class Walls {
 public:
  Walls(Mesh& mesh, int sheet_size, int layers) : mesh_(mesh), size_(sheet_size), layers_(layers) {}

  /// The wall behind the edge a -> b, which has the sheet on its left.
  void raise(int a, int b) {
    for (int k = 0; k < layers_; ++k) {
      const int a0 = at(a, k), a1 = at(a, k + 1), b0 = at(b, k), b1 = at(b, k + 1);
      mesh_.triangles.push_back({b0, a0, a1});
      mesh_.triangles.push_back({b0, a1, b1});
    }
  }

 private:
  int at(int v, int k) {
    if (k == 0) return v;
    if (k == layers_) return size_ + v;
    const auto [entry, fresh] = known_.try_emplace({v, k}, size_of(mesh_));
    if (fresh) {
      const double share = static_cast<double>(k) / layers_;
      const Vec3 front = mesh_.vertices[static_cast<std::size_t>(v)],
                 back = mesh_.vertices[static_cast<std::size_t>(size_ + v)];
      mesh_.vertices.push_back((1 - share) * front + share * back);
    }
    return entry->second;
  }

  Mesh& mesh_;
  int size_, layers_;
  std::map<std::pair<int, int>, int> known_;
};

}  // namespace

Mesh thicken(const Mesh& sheet, const Surface& surface, double thickness, double edge, std::string& why) {
  const std::vector<MeshEdge> edges = mesh_edges(sheet);
  const std::vector<std::vector<int>> loops = boundary_loops(sheet, edges);
  if (loops.empty()) return sheet;
  std::size_t around = 0;
  for (const auto& loop : loops) around += loop.size();
  const double layers = std::max(1.0, std::round(thickness / edge));
  if (const double walls = 2 * layers * static_cast<double>(around); walls > kMaxWallTriangles) {
    why = fmt::format(
        "would have walls of {:.3g} million triangles, more than {:.3g}: make it thinner, or its edges longer",
        1e-6 * walls, 1e-6 * kMaxWallTriangles);
    return {};
  }
  Mesh out = sheet;
  for (const Vec3& v : sheet.vertices) {
    SurfacePoint s;
    if (!surface.project(v, s)) {
      why = "has a vertex without a normal";
      return {};
    }
    // Behind a surface that bends with k = -1/R, areas shrink by 1 + k t.
    const double mean = 0.5 * s.S.trace(), half = std::hypot(0.5 * (s.S(0, 0) - s.S(1, 1)), s.S(0, 1));
    if (!(1 + thickness * (mean - half) > 0)) {
      why = fmt::format("bulges with a radius of {:.3g} mm: a solid {:.3g} mm thick would fold behind it",
                        -1e3 / (mean - half), 1e3 * thickness);
      return {};
    }
    out.vertices.push_back(v - thickness * s.n);
  }
  const int n = size_of(sheet);
  for (const auto& t : sheet.triangles) out.triangles.push_back({t[0] + n, t[2] + n, t[1] + n});
  Walls walls(out, n, static_cast<int>(layers));
  for (const std::vector<int>& loop : loops)
    for (std::size_t k = 0; k < loop.size(); ++k) walls.raise(loop[k], loop[(k + 1) % loop.size()]);
  return out;
}

}  // namespace genu
