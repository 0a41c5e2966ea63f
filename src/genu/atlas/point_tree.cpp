#include "genu/atlas/point_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "genu/atlas/tolerances.h"

namespace genu {
namespace {

constexpr int kLeaf = 8;

Vec6 key_of(const FacingPoint& p) {
  Vec6 key;
  key << p.at, kTurnLength * p.normal;
  return key;
}

}  // namespace

std::vector<FacingPoint> facing_vertices(const Mesh& mesh, std::size_t most) {
  std::vector<FacingPoint> all(mesh.vertices.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i].at = mesh.vertices[i];
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[at(t[0])], &b = mesh.vertices[at(t[1])], &c = mesh.vertices[at(t[2])];
    const Vec3 area = (b - a).cross(c - a);
    for (const int corner : t) all[at(corner)].normal += area;
  }
  std::erase_if(all, [](const FacingPoint& p) { return !(p.normal.squaredNorm() > 0); });
  for (FacingPoint& p : all) p.normal.normalize();
  if (all.size() <= most) return all;
  std::vector<FacingPoint> some;
  for (std::size_t k = 0; k < most; ++k) some.push_back(all[k * all.size() / most]);
  return some;
}

PointTree::PointTree(std::vector<FacingPoint> points) : points_(std::move(points)), order_(points_.size()) {
  for (const FacingPoint& p : points_) keys_.push_back(key_of(p));
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.push_back({0, static_cast<int>(points_.size())});
  split(0);
}

void PointTree::split(int node) {
  const int first = nodes_[at(node)].first, last = nodes_[at(node)].last;
  if (last - first <= kLeaf) return;
  Vec6 low = keys_[at(order_[at(first)])], high = low;
  for (int k = first; k < last; ++k) {
    low = low.cwiseMin(keys_[at(order_[at(k)])]);
    high = high.cwiseMax(keys_[at(order_[at(k)])]);
  }
  Eigen::Index axis = 0;
  if (!((high - low).maxCoeff(&axis) > 0)) return;
  const int middle = first + (last - first) / 2;
  const auto less = [&](int a, int b) {
    const double x = keys_[at(a)][axis], y = keys_[at(b)][axis];
    return x != y ? x < y : a < b;
  };
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last, less);
  const int children = static_cast<int>(nodes_.size());
  nodes_[at(node)].axis = static_cast<int>(axis);
  nodes_[at(node)].split = keys_[at(order_[at(middle)])][axis];
  nodes_[at(node)].children = children;
  nodes_.push_back({first, middle});
  nodes_.push_back({middle, last});
  split(children);
  split(children + 1);
}

void PointTree::search(int node, const Vec6& key, Best& best) const {
  const Node& n = nodes_[at(node)];
  if (n.children < 0) {
    for (int k = n.first; k < n.last; ++k) {
      const int i = order_[at(k)];
      const double d = (keys_[at(i)] - key).squaredNorm();
      if (d < best.distance || (d == best.distance && i < best.point)) best = {d, i};
    }
    return;
  }
  const double beyond = key[n.axis] - n.split;
  const int near = n.children + (beyond >= 0 ? 1 : 0), far = n.children + (beyond >= 0 ? 0 : 1);
  search(near, key, best);
  if (beyond * beyond <= best.distance) search(far, key, best);
}

int PointTree::nearest(const FacingPoint& p) const {
  Best best{std::numeric_limits<double>::infinity(), -1};
  if (!points_.empty()) search(0, key_of(p), best);
  return best.point;
}

}  // namespace genu
