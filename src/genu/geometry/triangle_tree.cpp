#include "genu/geometry/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace genu {
namespace {

constexpr int kLeaf = 4;        // triangles
constexpr int kMostDepth = 64;  // of the tree: halves of at most 2^31 triangles

constexpr double kOutside = std::numeric_limits<double>::infinity();

/// The part of a segment inside a box grown by `margin`: its entry, or infinity where there is none.
struct Slab {
  Slab(const Vec3& o, const Vec3& d, double l) : origin(o), length(l) {
    // Along an axis that the segment does not move in, it is inside for ever or never: a very large slope says the same
    // without a case of its own.
    constexpr double kStill = 1e-30;
    for (Eigen::Index i = 0; i < 3; ++i) inverse[i] = 1 / (std::abs(d[i]) < kStill ? kStill : d[i]);
  }

  double entry(const Vec3& low, const Vec3& high, double margin, double most) const {
    double in = 0, out = most;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const double a = (low[i] - margin - origin[i]) * inverse[i], b = (high[i] + margin - origin[i]) * inverse[i];
      in = std::max(in, std::min(a, b));
      out = std::min(out, std::max(a, b));
    }
    return in <= out ? in : kOutside;
  }

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
  Vec3 low = Vec3::Constant(kOutside), high = -low, low_middle = low, high_middle = high;
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

/// A ray with what its triangles are asked for: points are sheared along it into a plane across it, each alike for all
/// triangles that share it, so that no ray passes between them (Woop, Benthin and Wald 2013).
struct TriangleTree::Line {
  Line(const Vec3& o, const Vec3& d, double l) : origin(o), direction(d), length(l) {
    d.cwiseAbs().maxCoeff(&z);
    x = (z + 1) % 3;
    y = (z + 2) % 3;
    slope = Vec2(d[x], d[y]) / d[z];
  }

  Vec2 across(const Vec3& p) const {
    const Vec3 from = p - origin;
    return {from[x] - slope[0] * from[z], from[y] - slope[1] * from[z]};
  }

  Vec3 origin, direction;
  double length;
  Eigen::Index x = 0, y = 0, z = 0;
  Vec2 slope;
};

void TriangleTree::meet(std::size_t k, const Line& line, double side, Hit& best) const {
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

void TriangleTree::search(const Line& line, double side, Hit& best) const {
  if (nodes_.empty()) return;
  const Slab slab(line.origin, line.direction, line.length);
  struct Waiting {
    int node;
    double entry;
  };
  Waiting stack[kMostDepth];
  int top = 0;
  const double root = slab.entry(nodes_[0].low, nodes_[0].high, 0, line.length);
  if (root == kOutside) return;
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
      if (child[i].entry != kOutside) stack[top++] = child[i];
  }
}

TriangleTree::Hit TriangleTree::leaving(const Vec3& origin, const Vec3& direction, double length, int hint) const {
  const Line line(origin, direction, length);
  Hit best;
  if (hint >= 0) meet(place(hint), line, 1, best);
  search(line, 1, best);
  return best;
}

TriangleTree::Hit TriangleTree::entering(const Vec3& origin, const Vec3& direction, double length) const {
  Hit best;
  search(Line(origin, direction, length), -1, best);
  return best;
}

std::size_t TriangleTree::clear_by(const Vec3& origin, const Vec3& direction, double length,
                                   std::span<const double> margins, int& met) const {
  std::size_t level = 0;
  if (nodes_.empty()) return level;
  const Slab slab(origin, direction, length);
  const auto try_triangle = [&](std::size_t k) {
    const auto& c = corners_[k];
    const Vec3 low = c[0].cwiseMin(c[1]).cwiseMin(c[2]), high = c[0].cwiseMax(c[1]).cwiseMax(c[2]);
    while (level < margins.size() && slab.entry(low, high, margins[level], length) != kOutside) {
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
    if (slab.entry(node.low, node.high, margins[level], length) == kOutside) continue;
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
