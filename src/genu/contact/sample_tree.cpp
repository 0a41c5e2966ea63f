#include "genu/contact/sample_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace genu {
namespace {

constexpr int kLeafSize = 12;

/// `axis`: of the longest side of the box around the node's points.
SampleNode sphere_round(const std::vector<Vec3>& points, const std::vector<int>& order, int first, int last,
                        int& axis) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  const auto point = [&](int k) -> const Vec3& { return points[at(order[at(k)])]; };
  for (int k = first; k < last; ++k) low = low.cwiseMin(point(k)), high = high.cwiseMax(point(k));
  SampleNode node;
  node.first = first;
  node.last = last;
  node.centre = 0.5 * (low + high);
  for (int k = first; k < last; ++k) node.radius = std::max(node.radius, (point(k) - node.centre).norm());
  Eigen::Index longest = 0;
  (high - low).maxCoeff(&longest);
  axis = static_cast<int>(longest);
  return node;
}

}  // namespace

SampleTree build_sample_tree(const std::vector<Vec3>& points) {
  SampleTree tree;
  tree.order.resize(points.size());
  std::iota(tree.order.begin(), tree.order.end(), 0);
  if (points.empty()) return tree;
  std::vector<int> axes(1);
  tree.nodes.push_back(sphere_round(points, tree.order, 0, static_cast<int>(points.size()), axes[0]));
  for (std::size_t g = 0; g < tree.nodes.size(); ++g) {
    const SampleNode node = tree.nodes[g];
    if (node.last - node.first <= kLeafSize) continue;
    const int middle = (node.first + node.last) / 2, axis = axes[g];
    const auto coordinate = [&](int i) { return std::pair(points[at(i)][axis], i); };
    std::nth_element(tree.order.begin() + node.first, tree.order.begin() + middle, tree.order.begin() + node.last,
                     [&](int i, int j) { return coordinate(i) < coordinate(j); });
    tree.nodes[g].children = static_cast<int>(tree.nodes.size());
    axes.resize(axes.size() + 2);
    tree.nodes.push_back(sphere_round(points, tree.order, node.first, middle, axes[axes.size() - 2]));
    tree.nodes.push_back(sphere_round(points, tree.order, middle, node.last, axes[axes.size() - 1]));
  }
  return tree;
}

}  // namespace genu
