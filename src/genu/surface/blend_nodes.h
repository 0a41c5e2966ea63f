// The nodes of a blend: where they stand, the polynomial height fitted at each, and the sheet each belongs to.
#pragma once

#include <span>
#include <vector>

#include "genu/surface/local_fit.h"

namespace genu {

struct NodeSeed {
  Vec3 position = Vec3::Zero();   ///< m, on the mesh
  Vec3 normal = Vec3::UnitZ();    ///< outward
  std::array<int, 3> vertices{};  ///< where a walk over the mesh starts; entry 0 is repeated for a vertex
  int component = 0;
  int face = 0;  ///< the part of the component within creases; -1 on a crease
};

/// Points of the mesh no nearer than `spacing` (m) to each other within a sheet, and no point of the mesh much farther
/// than that from one: greedy over the vertices in their order, then over points of the facets too large for that.
std::vector<NodeSeed> sample_nodes(const Mesh& mesh, const VertexGraph& graph, double spacing);

/// Fits at all seeds, in parallel; the result does not depend on the number of threads. Where the surface turns out to
/// be too sharply curved for `fit_radius` (m), the fit is repeated with a narrower one, down to `least_radius`.
std::vector<HeightFit> fit_nodes(const Mesh& mesh, const VertexGraph& graph, std::span<const NodeSeed> seeds,
                                 double fit_radius, double least_radius, int degree);

/// Neighbours of each node i: adjacent[first[i] .. first[i + 1]), ascending, i itself left out.
struct NodeLinks {
  std::vector<int> first = {0};
  std::vector<int> adjacent;

  template <typename Archive>
  void serialize(Archive& a) {
    a(first, adjacent);
  }

  std::span<const int> of(int i) const {
    return {adjacent.data() + first[i], static_cast<std::size_t>(first[i + 1] - first[i])};
  }

  /// The links (i, j) that `keep` holds true for.
  template <class F>
  NodeLinks kept(F&& keep) const {
    NodeLinks links;
    for (int i = 0; i + 1 < static_cast<int>(first.size()); ++i) {
      for (int j : of(i)) {
        if (keep(i, j)) links.adjacent.push_back(j);
      }
      links.first.push_back(static_cast<int>(links.adjacent.size()));
    }
    return links;
  }
};

/// All pairs nearer than `distance` (m).
NodeLinks link_nodes(std::span<const Vec3> positions, double distance);

/// A sheet for each node, decided once: two nodes that a single point could reach (`blend_radius`, m) but that face
/// opposite ways, or lie on different `faces` (-1: on any), are never in one sheet.
std::vector<int> label_sheets(std::span<const Vec3> positions, std::span<const Vec3> normals,
                              std::span<const int> faces, const NodeLinks& near, double blend_radius);

}  // namespace genu
