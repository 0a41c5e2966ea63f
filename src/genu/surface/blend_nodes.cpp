#include "genu/surface/blend_nodes.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "genu/mesh/cell_lists.h"
#include "genu/surface/tolerances.h"

namespace genu {
namespace {

/// Accepts points that keep their distance from the accepted ones of the same side and component.
class Thinner {
 public:
  Thinner(double spacing, std::vector<NodeSeed>& accepted)
      : limit_(spacing * spacing * kTieFactor), inverse_(1 / spacing), accepted_(accepted) {}

  void offer(const NodeSeed& seed) {
    const std::array<int, 3> c = cell(seed.position);
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          const auto it = head_.find(key({c[0] + x, c[1] + y, c[2] + z}));
          for (int i = it == head_.end() ? -1 : it->second; i >= 0; i = next_[i]) {
            if (crowds(accepted_[i], seed)) return;
          }
        }
      }
    }
    const auto [it, fresh] = head_.try_emplace(key(c), -1);
    next_.push_back(it->second);
    it->second = static_cast<int>(accepted_.size());
    accepted_.push_back(seed);
  }

 private:
  bool crowds(const NodeSeed& a, const NodeSeed& b) const {
    return (a.position - b.position).squaredNorm() < limit_ && a.component == b.component &&
           a.normal.dot(b.normal) > kFacesAlike;
  }
  std::array<int, 3> cell(const Vec3& p) const {
    return {static_cast<int>(std::floor(p.x() * inverse_)), static_cast<int>(std::floor(p.y() * inverse_)),
            static_cast<int>(std::floor(p.z() * inverse_))};
  }
  static std::uint64_t key(const std::array<int, 3>& c) {
    std::uint64_t k = 0;
    for (int v : c) k = (k << 21) | (static_cast<std::uint64_t>(v) & 0x1fffff);
    return k;
  }

  double limit_, inverse_;
  std::vector<NodeSeed>& accepted_;
  std::unordered_map<std::uint64_t, int> head_;
  std::vector<int> next_;
};

/// Whether all these vertices are on a crease: a fit there takes from both sides.
bool amid_crease(const VertexGraph& graph, const std::array<int, 3>& vertices) {
  return std::all_of(vertices.begin(), vertices.end(), [&](int v) { return graph.is_on_crease(v); });
}

/// Whether a node of a face stands near enough to reach over a place on the crease beside it.
bool covered(const NodeSeed& place, const std::vector<NodeSeed>& nodes, double spacing) {
  const double reach = kCreaseReach * spacing;
  return std::any_of(nodes.begin(), nodes.end(), [&](const NodeSeed& node) {
    return (node.position - place.position).squaredNorm() < reach * reach && node.component == place.component &&
           node.normal.dot(place.normal) > kFacesAlike;
  });
}

/// Offers points inside triangle t, as close together as the spacing asks.
void offer_facet(const Mesh& mesh, const VertexGraph& graph, int t, double spacing, Thinner& thinner) {
  const auto& [a, b, c] = mesh.triangles[t];
  const Vec3 &A = mesh.vertices[a], &B = mesh.vertices[b], &C = mesh.vertices[c];
  const double longest = std::sqrt(std::max({(B - A).squaredNorm(), (C - B).squaredNorm(), (A - C).squaredNorm()}));
  const int parts = static_cast<int>(std::min(64.0, std::floor(longest / spacing)));
  if (parts < 2 || amid_crease(graph, {a, b, c})) return;
  const int face = std::max({graph.face_of(a), graph.face_of(b), graph.face_of(c)});
  for (int i = 0; i <= parts; ++i) {
    for (int j = 0; j <= parts - i; ++j) {
      const double s = static_cast<double>(i) / parts, r = static_cast<double>(j) / parts, q = 1 - s - r;
      const Vec3 n = q * graph.normals[a] + s * graph.normals[b] + r * graph.normals[c];
      if (n.norm() < 0.1) continue;
      thinner.offer({q * A + s * B + r * C, n.normalized(), {a, b, c}, graph.component[a], face});
    }
  }
}

}  // namespace

std::vector<NodeSeed> sample_nodes(const Mesh& mesh, const VertexGraph& graph, double spacing) {
  std::vector<NodeSeed> seeds;
  Thinner thinner(spacing, seeds);
  for (int v = 0; v < static_cast<int>(mesh.vertices.size()); ++v) {
    if (graph.component[v] < 0 || graph.normals[v].isZero() || graph.is_on_crease(v)) continue;
    thinner.offer({mesh.vertices[v], graph.normals[v], {v, v, v}, graph.component[v], graph.face_of(v)});
  }
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) offer_facet(mesh, graph, t, spacing, thinner);
  const std::vector<NodeSeed> of_faces = graph.on_crease.empty() ? std::vector<NodeSeed>() : seeds;
  for (int v = 0; v < static_cast<int>(graph.on_crease.size()); ++v) {
    const NodeSeed place{mesh.vertices[v], graph.normals[v], {v, v, v}, graph.component[v], -1};
    if (!graph.is_on_crease(v) || graph.component[v] < 0 || graph.normals[v].isZero()) continue;
    if (!covered(place, of_faces, spacing)) thinner.offer(place);
  }
  return seeds;
}

std::vector<HeightFit> fit_nodes(const Mesh& mesh, const VertexGraph& graph, std::span<const NodeSeed> seeds,
                                 double fit_radius, double least_radius, int degree) {
  std::vector<HeightFit> fits(seeds.size());
  tbb::enumerable_thread_specific<HeightFitter> fitters([&] { return HeightFitter(mesh, graph); });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, seeds.size(), 16), [&](const auto& range) {
    HeightFitter& fitter = fitters.local();
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      FitRequest request{seeds[i].position, seeds[i].normal, seeds[i].vertices, fit_radius, degree, true};
      fits[i] = fitter.fit(request);
      if (fits[i].degree == 0) continue;
      const double sharpness = fits[i].curvature(fits[i].origin).norm();
      request.radius = std::max(least_radius, kMaxOfCurvature / std::max(sharpness, 1e-300));
      if (request.radius < kWorthwhileRadius * fit_radius) fits[i] = fitter.fit(request);
    }
  });
  return fits;
}

NodeLinks link_nodes(std::span<const Vec3> positions, double distance) {
  const CellLists cells(positions, std::span(&distance, 1), 0.5 * distance);
  std::vector<std::vector<int>> found(positions.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, positions.size(), 64), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      for (int j : cells.at(positions[i])) {
        if (j == static_cast<int>(i)) continue;
        if ((positions[i] - positions[j]).squaredNorm() < distance * distance) found[i].push_back(j);
      }
    }
  });
  NodeLinks links;
  for (const auto& list : found) {
    links.adjacent.insert(links.adjacent.end(), list.begin(), list.end());
    links.first.push_back(static_cast<int>(links.adjacent.size()));
  }
  return links;
}

std::vector<int> label_sheets(std::span<const Vec3> positions, std::span<const Vec3> normals,
                              std::span<const int> faces, const NodeLinks& near, double blend_radius) {
  const int count = static_cast<int>(positions.size());
  const double step = 0.8 * blend_radius;
  const auto conflict = [&](int i, int j) {
    const bool apart = faces[i] != faces[j] && faces[i] >= 0 && faces[j] >= 0;
    return apart || normals[i].dot(normals[j]) < kFacesAway;
  };
  std::vector<int> sheet(count, -1);
  const auto fits_into = [&](int i, int label) {
    return std::none_of(near.of(i).begin(), near.of(i).end(),
                        [&](int j) { return sheet[j] == label && conflict(i, j); });
  };
  int sheets = 0;
  std::vector<int> queue;
  for (int seed = 0; seed < count; ++seed) {
    if (sheet[seed] >= 0) continue;
    const int label = sheets++;
    sheet[seed] = label;
    queue.assign(1, seed);
    for (std::size_t next = 0; next < queue.size(); ++next) {
      const int i = queue[next];
      for (int j : near.of(i)) {
        if (sheet[j] >= 0 || conflict(i, j) || normals[i].dot(normals[j]) < kFacesAlike) continue;
        if ((positions[i] - positions[j]).squaredNorm() > step * step || !fits_into(j, label)) continue;
        sheet[j] = label;
        queue.push_back(j);
      }
    }
  }
  return sheet;
}

}  // namespace genu
