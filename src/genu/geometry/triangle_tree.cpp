#include "genu/geometry/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace genu {
namespace {

constexpr int kLeaf = 4;        // triangles
constexpr int kMostDepth = 64;  // of the tree: halves of at most 2^31 triangles

/// The part of a segment inside a box grown by `margin`: its entry, or infinity where there is none.
struct Slab {
  Slab(const Vec3& o, const Vec3& d, double l) : origin(o), inverse(d.cwiseInverse()), length(l) {}

  double entry(const Vec3& low, const Vec3& high, double margin, double most) const {
    double in = 0, out = most;
    for (Eigen::Index i = 0; i < 3; ++i) {
      if (std::isinf(inverse[i])) {
        if (origin[i] < low[i] - margin || origin[i] > high[i] + margin) return kOutside;
        continue;
      }
      const double a = (low[i] - margin - origin[i]) * inverse[i], b = (high[i] + margin - origin[i]) * inverse[i];
      in = std::max(in, std::min(a, b));
      out = std::min(out, std::max(a, b));
    }
    return in <= out ? in : kOutside;
  }

  static constexpr double kOutside = std::numeric_limits<double>::infinity();
  Vec3 origin, inverse;
  double length;
};

}  // namespace

TriangleTree::TriangleTree(const Mesh& mesh) {
  const std::size_t n = mesh.triangles.size();
  triangle_.resize(n);
  std::iota(triangle_.begin(), triangle_.end(), 0);
  corners_.reserve(n);
  for (const auto& t : mesh.triangles)
    corners_.push_back({mesh.vertices[static_cast<std::size_t>(t[0])], mesh.vertices[static_cast<std::size_t>(t[1])],
                        mesh.vertices[static_cast<std::size_t>(t[2])]});
  if (n > 0) build();
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
    place_[static_cast<std::size_t>(triangle_[k])] = static_cast<int>(k);
  }
  corners_ = std::move(ordered);
  // Boxes touch what they hold: rounding in the slab test must not lose a triangle in a plane of the axes.
  constexpr double kGrow = 1e-12;
  for (Node& node : nodes_) {
    const Vec3 more = kGrow * (node.low.cwiseAbs().cwiseMax(node.high.cwiseAbs()) + (node.high - node.low));
    node.low -= more;
    node.high += more;
  }
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
  if (last - first <= kLeaf) return;
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

/// The signs of the three volumes between the ray and an edge are computed alike from both sides of the edge, so that
/// the same rounding decides for both triangles.
bool TriangleTree::meets(std::size_t k, const Vec3& origin, const Vec3& direction, double side, double length,
                         Hit& best) const {
  const double across = areas_[k].dot(direction);
  if (!(side * across > 0)) return false;
  const auto& c = corners_[k];
  const Vec3 a = c[0] - origin, b = c[1] - origin, d = c[2] - origin;
  const Vec3 line = side * direction;
  if (line.dot(b.cross(d)) < 0 || line.dot(d.cross(a)) < 0 || line.dot(a.cross(b)) < 0) return false;
  const double t = areas_[k].dot(a) / across;
  if (!(t > 0 && t <= length)) return false;
  if (best && (t > best.distance || (t == best.distance && triangle_[k] >= best.triangle))) return false;
  best = {triangle_[k], t};
  return true;
}

void TriangleTree::search(const Vec3& origin, const Vec3& direction, double side, double length, Hit& best) const {
  if (nodes_.empty()) return;
  const Slab slab(origin, direction, length);
  struct Waiting {
    int node;
    double entry;
  };
  Waiting stack[kMostDepth];
  int top = 0;
  const double root = slab.entry(nodes_[0].low, nodes_[0].high, 0, length);
  if (std::isinf(root)) return;
  stack[top++] = {0, root};
  while (top > 0) {
    const Waiting next = stack[--top];
    const double most = best ? best.distance : length;
    if (next.entry > most) continue;
    const Node& node = nodes_[static_cast<std::size_t>(next.node)];
    if (node.children < 0) {
      for (int k = node.first; k < node.last; ++k)
        meets(static_cast<std::size_t>(k), origin, direction, side, length, best);
      continue;
    }
    Waiting child[2];
    for (int i = 0; i < 2; ++i) {
      const Node& c = nodes_[static_cast<std::size_t>(node.children + i)];
      child[i] = {node.children + i, slab.entry(c.low, c.high, 0, most)};
    }
    const int nearer = child[1].entry < child[0].entry ? 1 : 0;
    for (const int i : {1 - nearer, nearer})
      if (!std::isinf(child[i].entry)) stack[top++] = child[i];
  }
}

TriangleTree::Hit TriangleTree::leaving(const Vec3& origin, const Vec3& direction, double length, int hint) const {
  Hit best;
  if (hint >= 0) meets(place(hint), origin, direction, 1, length, best);
  search(origin, direction, 1, length, best);
  return best;
}

TriangleTree::Hit TriangleTree::entering(const Vec3& origin, const Vec3& direction, double length) const {
  Hit best;
  search(origin, direction, -1, length, best);
  return best;
}

bool TriangleTree::near(const Vec3& origin, const Vec3& direction, double length, double margin) const {
  if (nodes_.empty()) return false;
  const Slab slab(origin - margin * direction, direction, length + 2 * margin);
  int stack[kMostDepth];
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Node& node = nodes_[static_cast<std::size_t>(stack[--top])];
    if (std::isinf(slab.entry(node.low, node.high, margin, slab.length))) continue;
    if (node.children >= 0) {
      stack[top++] = node.children;
      stack[top++] = node.children + 1;
      continue;
    }
    for (int k = node.first; k < node.last; ++k) {
      const auto& c = corners_[static_cast<std::size_t>(k)];
      const Vec3 low = c[0].cwiseMin(c[1]).cwiseMin(c[2]), high = c[0].cwiseMax(c[1]).cwiseMax(c[2]);
      if (!std::isinf(slab.entry(low, high, margin, slab.length))) return true;
    }
  }
  return false;
}

}  // namespace genu
