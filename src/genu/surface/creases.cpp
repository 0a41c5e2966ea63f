#include "genu/surface/creases.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "genu/mesh/mesh_topology.h"
#include "genu/mesh/tolerances.h"
#include "genu/surface/patch_shells.h"
#include "genu/surface/tolerances.h"

namespace genu {
namespace {

/// A vertex's patch of 3 edges: the rms of its heights off any polynomial, m (negative: too few vertices), and the
/// cosine of the largest angle between the vertex's normal and those of two rings.
struct Patch {
  double rest = -1, bend = 1;
};

class Patches {
 public:
  Patches(const Mesh& mesh, const VertexGraph& graph)
      : mesh_(mesh),
        graph_(graph),
        radius_(kNarrowestPatch * graph.median_edge),
        fitters_([this] { return ShellFitter(mesh_, graph_); }) {}

  /// Of every `step`-th vertex.
  std::vector<Patch> measure(std::size_t step) {
    std::vector<Patch> out((mesh_.vertices.size() + step - 1) / step);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, out.size(), 16), [&](const auto& range) {
      ShellFitter& fitter = fitters_.local();
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        const int v = static_cast<int>(i * step);
        ShellEnergies energies;
        if (graph_.component[at(v)] < 0) continue;
        out[i].bend = bend(v);
        if (fitter.energies(v, radius_, energies)) out[i].rest = std::sqrt(energies.back());
      }
    });
    return out;
  }

 private:
  double bend(int v) const {
    double least = 1;
    for (const int w : graph_.neighbours(v)) {
      least = std::min(least, graph_.normals[at(w)].dot(graph_.normals[at(v)]));
      for (const int u : graph_.neighbours(w))
        least = std::min(least, graph_.normals[at(u)].dot(graph_.normals[at(v)]));
    }
    return least;
  }

  const Mesh& mesh_;
  const VertexGraph& graph_;
  double radius_;
  tbb::enumerable_thread_specific<ShellFitter> fitters_;
};

/// What the quiet tenth of the patches has, m, and whether that is no more than rounding of the coordinates.
class Level {
 public:
  Level(const Mesh& mesh, const std::vector<Patch>& patches) {
    std::vector<double> rest;
    for (const Patch& p : patches)
      if (p.rest >= 0) rest.push_back(p.rest);
    if (rest.empty()) return;
    const auto quiet = rest.begin() + static_cast<std::ptrdiff_t>(kQuietShare * static_cast<double>(rest.size()));
    std::nth_element(rest.begin(), quiet, rest.end());
    double farthest = 0;
    for (const Vec3& v : mesh.vertices) farthest = std::max(farthest, v.cwiseAbs().maxCoeff());
    const double rounding = std::numeric_limits<float>::epsilon() * farthest;
    machined_ = *quiet <= rounding;
    loud_ = kLoudPatch * std::max(*quiet, rounding);
  }

  bool machined() const { return machined_; }
  bool crease(const Patch& p) const { return p.rest > loud_ && (machined_ || p.bend < kCreasePatchBend); }

 private:
  double loud_ = std::numeric_limits<double>::infinity();
  bool machined_ = false;
};

/// The bends over all inner edges of a mesh, as cosines.
class Bends {
 public:
  explicit Bends(const Mesh& mesh) : edges_(mesh_edges(mesh)) {
    std::vector<Vec3> normals;
    normals.reserve(mesh.triangles.size());
    for (const auto& t : mesh.triangles) {
      const Vec3& a = mesh.vertices[at(t[0])];
      normals.emplace_back((mesh.vertices[at(t[1])] - a).cross(mesh.vertices[at(t[2])] - a).normalized());
    }
    std::erase_if(edges_, [](const MeshEdge& e) { return e.count != 2; });
    for (const MeshEdge& e : edges_) cosines_.push_back(normals[at(e.t[0])].dot(normals[at(e.t[1])]));
  }

  /// rad: what all but a tenth of the edges have that are near no crease; 0 where there are none.
  double usual(const std::vector<char>& near) const {
    std::vector<double> away;
    for (std::size_t i = 0; i < edges_.size(); ++i)
      if (near[at(edges_[i].v[0])] == 0 && near[at(edges_[i].v[1])] == 0) away.push_back(cosines_[i]);
    if (away.empty()) return 0;
    const auto tenth = away.begin() + static_cast<std::ptrdiff_t>(away.size() / 10);
    std::nth_element(away.begin(), tenth, away.end());
    return std::acos(std::clamp(*tenth, -1.0, 1.0));
  }

  /// rad
  double median() const {
    if (cosines_.empty()) return 0;
    std::vector<double> all = cosines_;
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return std::acos(std::clamp(*middle, -1.0, 1.0));
  }

  /// Whether a vertex has an edge that bends by more than `angle` (rad).
  std::vector<char> sharper_than(double angle, std::size_t vertices) const {
    std::vector<char> on(vertices, 0);
    for (std::size_t i = 0; i < edges_.size(); ++i)
      if (cosines_[i] < std::cos(angle)) on[at(edges_[i].v[0])] = on[at(edges_[i].v[1])] = 1;
    return on;
  }

 private:
  std::vector<MeshEdge> edges_;
  std::vector<double> cosines_;
};

/// Marks the neighbours of all that are marked.
void widen(const VertexGraph& graph, std::vector<char>& marked) {
  const std::vector<char> before = marked;
  for (std::size_t v = 0; v < before.size(); ++v)
    if (before[v] != 0)
      for (const int w : graph.neighbours(static_cast<int>(v))) marked[at(w)] = 1;
}

/// Numbers the parts within creases. One with too few vertices for a fit is taken for a part of the crease.
void find_faces(VertexGraph& graph) {
  graph.face.assign(graph.on_crease.size(), -1);
  int faces = 0;
  std::vector<int> part;
  for (std::size_t seed = 0; seed < graph.face.size(); ++seed) {
    if (graph.face[seed] >= 0 || graph.on_crease[seed] != 0 || graph.component[seed] < 0) continue;
    part.assign(1, static_cast<int>(seed));
    graph.face[seed] = faces;
    for (std::size_t next = 0; next < part.size(); ++next)
      for (const int w : graph.neighbours(part[next]))
        if (graph.face[at(w)] < 0 && graph.on_crease[at(w)] == 0) {
          graph.face[at(w)] = faces;
          part.push_back(w);
        }
    if (part.size() >= kFewestOfFace) {
      ++faces;
      continue;
    }
    for (const int v : part) graph.face[at(v)] = -1, graph.on_crease[at(v)] = 1;
  }
}

}  // namespace

VertexGraph graph_with_creases(const Mesh& mesh) {
  VertexGraph graph = vertex_graph(mesh);
  if (!(graph.median_edge > 0)) return graph;
  graph.steps = stair_steps(mesh);
  if (graph.steps) return graph;
  Patches patches(mesh, graph);
  const std::vector<Patch> probes = patches.measure(std::max<std::size_t>(1, mesh.vertices.size() / kCreaseProbes));
  const Level level(mesh, probes);
  const Bends bends(mesh);
  std::vector<char> near = bends.sharper_than(std::max(kFold, kFoldOverMedian * bends.median()), mesh.vertices.size());
  const auto loud = std::count_if(probes.begin(), probes.end(), [&](const Patch& p) { return level.crease(p); });
  const auto folded = std::count(near.begin(), near.end(), 1);
  if (static_cast<double>(loud) < kLoudShare * static_cast<double>(probes.size()) &&
      static_cast<double>(folded) < kFoldedShare * static_cast<double>(near.size()))
    return graph;
  for (int ring = 0; ring < kNarrowestRings; ++ring) widen(graph, near);
  const std::vector<Patch> all = patches.measure(1);
  for (std::size_t v = 0; v < all.size(); ++v)
    if (level.crease(all[v])) near[v] = 1;
  // A triangle that lies across a crease shares its bend between two edges.
  const double least = level.machined() ? kUnusualBend * bends.usual(near) : kSharpEdge;
  graph.on_crease = bends.sharper_than(std::clamp(least, kLeastSharpEdge, kSharpEdge), all.size());
  graph.near_crease = std::move(near);
  find_faces(graph);
  graph.machined = level.machined();
  return graph;
}

}  // namespace genu
