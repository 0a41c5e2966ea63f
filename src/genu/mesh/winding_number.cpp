#include "genu/mesh/winding_number.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "genu/mesh/tolerances.h"

namespace genu {
namespace {

constexpr int kGroupLeaf = 8;

/// Van Oosterom and Strackee 1983; positive where the triangle's inner side is seen.
double solid_angle(const std::array<Vec3, 3>& t, const Vec3& x) {
  const Vec3 a = t[0] - x, b = t[1] - x, c = t[2] - x;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

Vec3 middle(const std::array<Vec3, 3>& t) { return (t[0] + t[1] + t[2]) / 3; }

}  // namespace

WindingNumber::WindingNumber(const Mesh& mesh) {
  triangles_.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    triangles_.push_back({mesh.vertices[at(t[0])], mesh.vertices[at(t[1])], mesh.vertices[at(t[2])]});
  if (triangles_.empty()) return;
  split(0, static_cast<int>(triangles_.size()));
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const int first = nodes_[n].first, last = nodes_[n].last;
    if (last - first <= kGroupLeaf) continue;
    nodes_[n].children = static_cast<int>(nodes_.size());
    const int half = (first + last) / 2;
    split(first, half);
    split(half, last);
  }
}

void WindingNumber::split(int first, int last) {
  Node node;
  node.first = first;
  node.last = last;
  Vec3 low = middle(triangles_[at(first)]), high = low;
  double total = 0;
  for (int k = first; k < last; ++k) {
    const auto& t = triangles_[at(k)];
    const Vec3 area = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]), m = middle(t);
    node.area += area;
    node.centre += area.norm() * m;
    total += area.norm();
    low = low.cwiseMin(m);
    high = high.cwiseMax(m);
  }
  node.centre = total > 0 ? Vec3(node.centre / total) : low;
  for (int k = first; k < last; ++k)
    for (const Vec3& p : triangles_[at(k)]) node.radius = std::max(node.radius, (p - node.centre).norm());
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const auto before = [axis](const auto& s, const auto& t) {
    return s[0][axis] + s[1][axis] + s[2][axis] < t[0][axis] + t[1][axis] + t[2][axis];
  };
  if (last - first > kGroupLeaf)
    std::nth_element(triangles_.begin() + first, triangles_.begin() + (first + last) / 2, triangles_.begin() + last,
                     before);
  nodes_.push_back(node);
}

double WindingNumber::operator()(const Vec3& x) const {
  if (nodes_.empty()) return 0;
  double angle = 0;
  int open[128], count = 0;  // each level leaves one node open: far more than 2^31 triangles need
  open[count++] = 0;
  while (count > 0) {
    const Node& node = nodes_[at(open[--count])];
    const Vec3 d = node.centre - x;
    const double square = d.squaredNorm();
    if (square > kDipoleDistance * kDipoleDistance * node.radius * node.radius) {
      angle += node.area.dot(d) / (square * std::sqrt(square));
    } else if (node.children >= 0) {
      open[count++] = node.children;
      open[count++] = node.children + 1;
    } else {
      for (int k = node.first; k < node.last; ++k) angle += solid_angle(triangles_[at(k)], x);
    }
  }
  return angle / (4 * M_PI);
}

}  // namespace genu
