#include "genu/mesh/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "genu/mesh/mesh_topology.h"
#include "genu/mesh/tolerances.h"
#include "genu/mesh/triangle_ray.h"

namespace genu {
namespace {

constexpr int kTreeLeaf = 4;  // triangles

}  // namespace

TriangleTree::TriangleTree(const Mesh& mesh) {
  const std::size_t n = mesh.triangles.size();
  triangle_.resize(n);
  std::iota(triangle_.begin(), triangle_.end(), 0);
  corners_.reserve(n);
  for (const auto& t : mesh.triangles)
    corners_.push_back({mesh.vertices[static_cast<std::size_t>(t[0])], mesh.vertices[static_cast<std::size_t>(t[1])],
                        mesh.vertices[static_cast<std::size_t>(t[2])]});
  if (n == 0) return;
  build();
  find_neighbours(mesh);
}

/// Across an edge lies one triangle, wound alike, or none that counts.
void TriangleTree::find_neighbours(const Mesh& mesh) {
  vertex_count_ = static_cast<int>(mesh.vertices.size());
  vertices_.reserve(corners_.size());
  for (const int t : triangle_) vertices_.push_back(mesh.triangles[at(t)]);
  beside_.assign(corners_.size(), {-1, -1, -1});
  /// The corner at which a triangle leaves v[0] for v[1] or, `back`, the other way; 3: none.
  const auto side = [&](int place, const std::array<int, 2>& v, bool back) {
    std::size_t i = 0;
    while (i < 3 && !(vertices_[at(place)][i] == v[back] && vertices_[at(place)][(i + 1) % 3] == v[!back])) ++i;
    return i;
  };
  for (const MeshEdge& edge : mesh_edges(mesh)) {
    if (edge.count != 2) continue;
    const int p = place_[at(edge.t[0])], q = place_[at(edge.t[1])];
    const bool back = side(p, edge.v, false) == 3;
    const std::size_t i = side(p, edge.v, back), j = side(q, edge.v, !back);
    if (i == 3 || j == 3) continue;
    beside_[at(p)][i] = q;
    beside_[at(q)][j] = p;
  }
}

void TriangleTree::build() {
  nodes_.push_back({Vec3::Zero(), Vec3::Zero(), 0, static_cast<int>(triangle_.size())});
  for (std::size_t i = 0; i < nodes_.size(); ++i) split(static_cast<int>(i));
  std::vector<std::array<Vec3, 3>> ordered;
  ordered.reserve(corners_.size());
  place_.resize(triangle_.size());
  for (std::size_t k = 0; k < triangle_.size(); ++k) {
    const auto& c = corners_[static_cast<std::size_t>(triangle_[k])];
    ordered.push_back(c);
    areas_.emplace_back(0.5 * (c[1] - c[0]).cross(c[2] - c[0]));
    sizes_.push_back(areas_.back().norm());
    place_[static_cast<std::size_t>(triangle_[k])] = static_cast<int>(k);
  }
  corners_ = std::move(ordered);
  // Boxes touch what they hold: rounding in the slab test must not lose a triangle in a plane of the axes.
  for (Node& node : nodes_) {
    const Vec3 more = kBoxGrowth * (node.low.cwiseAbs().cwiseMax(node.high.cwiseAbs()) + (node.high - node.low));
    node.low -= more;
    node.high += more;
  }
  gather_clusters();
}

/// While the tree is built corners_ is still in the mesh's order.
void TriangleTree::split(int index) {
  const int first = nodes_[static_cast<std::size_t>(index)].first, last = nodes_[static_cast<std::size_t>(index)].last;
  const auto corners = [&](int t) -> const std::array<Vec3, 3>& { return corners_[static_cast<std::size_t>(t)]; };
  const auto middle = [&](int t) { return Vec3(corners(t)[0] + corners(t)[1] + corners(t)[2]); };
  Vec3 low = Vec3::Constant(Slab::kOutside), high = -low, low_middle = low, high_middle = high;
  for (int k = first; k < last; ++k) {
    const int t = triangle_[static_cast<std::size_t>(k)];
    for (const Vec3& p : corners(t)) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    low_middle = low_middle.cwiseMin(middle(t));
    high_middle = high_middle.cwiseMax(middle(t));
  }
  Node& node = nodes_[static_cast<std::size_t>(index)];
  node.low = low;
  node.high = high;
  if (last - first <= kTreeLeaf) return;
  Eigen::Index axis = 0;
  (high_middle - low_middle).maxCoeff(&axis);
  const int half = (first + last) / 2;
  const auto begin = triangle_.begin();
  std::nth_element(begin + first, begin + half, begin + last, [&](int a, int b) {
    const double x = middle(a)[axis], y = middle(b)[axis];
    return x < y || (x == y && a < b);
  });
  node.children = static_cast<int>(nodes_.size());
  nodes_.push_back({Vec3::Zero(), Vec3::Zero(), first, half});
  nodes_.push_back({Vec3::Zero(), Vec3::Zero(), half, last});
}

void TriangleTree::meet(std::size_t k, const RayLine& line, double side, Hit& best) const {
  const double facing = areas_[k].dot(line.direction);
  if (!(side * facing > 0)) return;
  const auto& c = corners_[k];
  const Vec2 a = line.across(c[0]), b = line.across(c[1]), d = line.across(c[2]);
  const double u = d[0] * b[1] - d[1] * b[0], v = a[0] * d[1] - a[1] * d[0], w = b[0] * a[1] - b[1] * a[0];
  if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return;
  const double t = areas_[k].dot(c[0] - line.origin) / facing;
  if (!(t > 0 && t <= line.length)) return;
  if (best && (t > best.distance || (t == best.distance && triangle_[k] >= best.triangle))) return;
  best = {triangle_[k], t};
}

void TriangleTree::search(const RayLine& line, double side, Hit& best) const {
  if (nodes_.empty()) return;
  const Slab slab(line.origin, line.direction, line.length);
  struct Waiting {
    int node;
    double entry;
  };
  Waiting stack[kMostDepth];
  int top = 0;
  const double root = slab.entry(nodes_[0].low, nodes_[0].high, 0, line.length);
  if (root == Slab::kOutside) return;
  stack[top++] = {0, root};
  while (top > 0) {
    const Waiting next = stack[--top];
    const double most = best ? best.distance : line.length;
    if (next.entry > most) continue;
    const Node& node = nodes_[static_cast<std::size_t>(next.node)];
    if (node.children < 0) {
      for (int k = node.first; k < node.last; ++k) meet(static_cast<std::size_t>(k), line, side, best);
      continue;
    }
    Waiting child[2];
    for (int i = 0; i < 2; ++i) {
      const Node& c = nodes_[static_cast<std::size_t>(node.children + i)];
      child[i] = {node.children + i, slab.entry(c.low, c.high, 0, most)};
    }
    const int nearer = child[1].entry < child[0].entry ? 1 : 0;
    for (const int i : {1 - nearer, nearer})
      if (child[i].entry != Slab::kOutside) stack[top++] = child[i];
  }
}

TriangleTree::Hit TriangleTree::leaving(const Vec3& origin, const Vec3& direction, double length, int hint) const {
  const RayLine line(origin, direction, length);
  Hit best;
  if (hint >= 0) meet(place(hint), line, 1, best);
  search(line, 1, best);
  return best;
}

TriangleTree::Hit TriangleTree::entering(const Vec3& origin, const Vec3& direction, double length) const {
  Hit best;
  search(RayLine(origin, direction, length), -1, best);
  return best;
}

std::size_t TriangleTree::clear_by(const Vec3& origin, const Vec3& direction, double length,
                                   std::span<const double> margins, Way way, int& met) const {
  std::size_t level = 0;
  if (nodes_.empty()) return level;
  const Slab slab(origin, direction, length);
  const auto try_triangle = [&](std::size_t k) {
    const auto& c = corners_[k];
    const Vec3 low = c[0].cwiseMin(c[1]).cwiseMin(c[2]), high = c[0].cwiseMax(c[1]).cwiseMax(c[2]);
    const double facing = (way == Way::out ? 1 : -1) * areas_[k].dot(direction), size = sizes_[k];
    while (level < margins.size() && facing + 2 * margins[level] / length * size > 0 &&
           slab.entry(low, high, margins[level], length) != Slab::kOutside) {
      ++level;
      met = triangle_[k];
    }
  };
  if (met >= 0) try_triangle(place(met));
  int stack[kMostDepth];
  int top = 0;
  stack[top++] = 0;
  while (top > 0 && level < margins.size()) {
    const Node& node = nodes_[static_cast<std::size_t>(stack[--top])];
    if (slab.entry(node.low, node.high, margins[level], length) == Slab::kOutside) continue;
    if (node.children >= 0) {
      stack[top++] = node.children;
      stack[top++] = node.children + 1;
      continue;
    }
    for (int k = node.first; k < node.last && level < margins.size(); ++k) try_triangle(static_cast<std::size_t>(k));
  }
  return level;
}

}  // namespace genu
