#include "genu/mesh_care/mesh_crossings.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <Eigen/Geometry>

#include "genu/mesh/tolerances.h"
#include "genu/mesh_care/tolerances.h"

namespace genu {
namespace {

constexpr int kBoxLeaf = 4;

using Corners = std::array<Vec3, 3>;

struct Box {
  Vec3 low, high;
  bool meets(const Box& o) const {
    return (low.array() <= o.high.array()).all() && (o.low.array() <= high.array()).all();
  }
  void add(const Box& o) { low = low.cwiseMin(o.low), high = high.cwiseMax(o.high); }
};

/// Six times the volume of the tetrahedron, 0 where it is rounding.
double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double value = u.cross(v).dot(w);
  return std::abs(value) <= kVolumeRounding * u.norm() * v.norm() * w.norm() ? 0 : value;
}

int sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// Does the segment pq meet the triangle, neither end being in its plane with the other? Coplanar ones do not.
bool pierces(const Vec3& p, const Vec3& q, const Corners& t) {
  const int sp = sign(volume(t[0], t[1], t[2], p)), sq = sign(volume(t[0], t[1], t[2], q));
  if (sp * sq > 0 || (sp == 0 && sq == 0)) return false;
  const int a = sign(volume(p, q, t[0], t[1])), b = sign(volume(p, q, t[1], t[2])), c = sign(volume(p, q, t[2], t[0]));
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

using Flat = std::array<Vec2, 3>;

int turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 u = b - a, v = c - a;
  const double value = u.x() * v.y() - u.y() * v.x();
  return std::abs(value) <= kTurnRounding * u.norm() * v.norm() ? 0 : sign(value);
}

bool edges_cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

bool holds(const Flat& t, const Vec2& p) {
  const int a = turn(t[0], t[1], p), b = turn(t[1], t[2], p), c = turn(t[2], t[0], p);
  return a != 0 && a == b && b == c;
}

/// Do two triangles of one plane overlap in more than a point or a line?
bool overlap_in_plane(const Corners& s, const Corners& t, const Vec3& normal) {
  Eigen::Index drop = 0;
  normal.cwiseAbs().maxCoeff(&drop);
  const auto flat = [drop](const Corners& c) {
    Flat out;
    for (std::size_t k = 0; k < 3; ++k) out[k] = {c[k][(drop + 1) % 3], c[k][(drop + 2) % 3]};
    return out;
  };
  const Flat a = flat(s), b = flat(t);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (edges_cross(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3])) return true;
  // Corners and the middles tell the rest: one triangle in the other, or the same triangle twice.
  const auto any_inside = [](const Flat& outer, const Flat& inner) {
    return std::any_of(inner.begin(), inner.end(), [&](const Vec2& p) { return holds(outer, p); }) ||
           holds(outer, (inner[0] + inner[1] + inner[2]) / 3);
  };
  return any_inside(a, b) || any_inside(b, a);
}

/// Does any side of s that has no corner in `shared` (bits of s's corners) pierce t?
bool sides_pierce(const Corners& s, int shared, const Corners& t) {
  for (int k = 0; k < 3; ++k) {
    const int a = k, b = (k + 1) % 3;
    if ((shared >> a & 1) != 0 || (shared >> b & 1) != 0) continue;
    if (pierces(s[at(a)], s[at(b)], t)) return true;
  }
  return false;
}

bool cross(const Mesh& mesh, const Corners& s, const Corners& t, int i, int j) {
  int shared_s = 0, shared_t = 0, shared = 0;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      if (mesh.triangles[at(i)][at(a)] == mesh.triangles[at(j)][at(b)])
        shared_s |= 1 << a, shared_t |= 1 << b, ++shared;
  if (shared >= 3) return true;
  const Vec3 normal = (s[1] - s[0]).cross(s[2] - s[0]);
  int above = 0, below = 0;
  for (int k = 0; k < 3; ++k) {
    if ((shared_t >> k & 1) != 0) continue;
    const int side = sign(volume(s[0], s[1], s[2], t[at(k)]));
    above += side > 0;
    below += side < 0;
  }
  const int free_corners = 3 - shared;
  if (above == free_corners || below == free_corners) return false;
  if (above == 0 && below == 0) return overlap_in_plane(s, t, normal);
  return shared < 2 && (sides_pierce(s, shared_s, t) || sides_pierce(t, shared_t, s));
}

/// Boxes round the triangles, halved along their longest side.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    if (order_.empty()) return;
    add(0, static_cast<int>(order_.size()));
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      const int first = nodes_[n].first, last = nodes_[n].last;
      if (last - first <= kBoxLeaf) continue;
      Eigen::Index axis = 0;
      (nodes_[n].box.high - nodes_[n].box.low).maxCoeff(&axis);
      const int half = (first + last) / 2;
      const auto middle = [&](int i) { return std::pair(boxes_[at(i)].low[axis] + boxes_[at(i)].high[axis], i); };
      std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last,
                       [&](int i, int j) { return middle(i) < middle(j); });
      nodes_[n].children = static_cast<int>(nodes_.size());
      add(first, half);
      add(half, last);
    }
  }

  template <class Visit>
  void visit_after(int i, Visit&& visit) const {
    int open[128], count = 0;
    open[count++] = 0;
    while (count > 0) {
      const Node& node = nodes_[at(open[--count])];
      if (!node.box.meets(boxes_[at(i)])) continue;
      if (node.children >= 0) {
        open[count++] = node.children;
        open[count++] = node.children + 1;
        continue;
      }
      for (int k = node.first; k < node.last; ++k)
        if (order_[at(k)] > i && boxes_[at(order_[at(k)])].meets(boxes_[at(i)])) visit(order_[at(k)]);
    }
  }

 private:
  struct Node {
    Box box;
    int first, last, children = -1;
  };
  void add(int first, int last) {
    Node node{boxes_[at(order_[at(first)])], first, last};
    for (int k = first + 1; k < last; ++k) node.box.add(boxes_[at(order_[at(k)])]);
    nodes_.push_back(node);
  }

  std::vector<Box> boxes_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace

std::vector<std::pair<int, int>> crossing_triangles(const Mesh& mesh, std::size_t most) {
  const int count = static_cast<int>(mesh.triangles.size());
  std::vector<Corners> corners(at(count));
  std::vector<Box> boxes(at(count));
  std::vector<char> flat(at(count), 0);
  for (int i = 0; i < count; ++i) {
    Corners& c = corners[at(i)];
    for (std::size_t k = 0; k < 3; ++k) c[k] = mesh.vertices[at(mesh.triangles[at(i)][k])];
    boxes[at(i)] = {c[0].cwiseMin(c[1]).cwiseMin(c[2]), c[0].cwiseMax(c[1]).cwiseMax(c[2])};
    const Vec3 u = c[1] - c[0], v = c[2] - c[0], w = c[2] - c[1];
    const double longest = std::max({u.squaredNorm(), v.squaredNorm(), w.squaredNorm()});
    flat[at(i)] = !(u.cross(v).norm() > kDegenerateSine * longest);
  }
  const BoxTree tree(std::move(boxes));
  std::vector<std::vector<int>> met(at(count));
  tbb::parallel_for(tbb::blocked_range<int>(0, count, 256), [&](const auto& range) {
    for (int i = range.begin(); i != range.end(); ++i) {
      if (flat[at(i)] != 0) continue;
      tree.visit_after(i, [&](int j) {
        if (flat[at(j)] == 0 && cross(mesh, corners[at(i)], corners[at(j)], i, j)) met[at(i)].push_back(j);
      });
      std::sort(met[at(i)].begin(), met[at(i)].end());
    }
  });
  std::vector<std::pair<int, int>> pairs;
  for (int i = 0; i < count; ++i)
    for (const int j : met[at(i)])
      if (pairs.size() < most) pairs.emplace_back(i, j);
  return pairs;
}

}  // namespace genu
