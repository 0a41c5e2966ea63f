#include "genu/mesh/winding_number.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

}  // namespace

struct WindingNumber::Pieces {
  struct Piece {
    std::array<Vec3, 3> corners;
    Vec3 area, middle, sum;  ///< m^2; m; m, of the corners
    double size;             ///< m^2: norm of the area
  };
  std::vector<Piece> all;
  std::vector<int> order;

  const Piece& operator[](int k) const { return all[at(order[at(k)])]; }
};

WindingNumber::WindingNumber(const Mesh& mesh) {
  Pieces pieces;
  pieces.all.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    const std::array<Vec3, 3> c{mesh.vertices[at(t[0])], mesh.vertices[at(t[1])], mesh.vertices[at(t[2])]};
    const Vec3 area = 0.5 * (c[1] - c[0]).cross(c[2] - c[0]), sum = c[0] + c[1] + c[2];
    pieces.all.push_back({c, area, sum / 3, sum, area.norm()});
  }
  if (pieces.all.empty()) return;
  pieces.order.resize(pieces.all.size());
  std::iota(pieces.order.begin(), pieces.order.end(), 0);
  split(pieces, 0, static_cast<int>(pieces.order.size()));
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const int first = nodes_[n].first, last = nodes_[n].last;
    if (last - first <= kGroupLeaf) continue;
    nodes_[n].children = static_cast<int>(nodes_.size());
    const int half = (first + last) / 2;
    split(pieces, first, half);
    split(pieces, half, last);
  }
  triangles_.reserve(pieces.order.size());
  for (const int i : pieces.order) triangles_.push_back(pieces.all[at(i)].corners);
}

void WindingNumber::split(Pieces& pieces, int first, int last) {
  Node node;
  node.first = first;
  node.last = last;
  Vec3 low = pieces[first].middle, high = low;
  double total = 0, square = 0;
  for (int k = first; k < last; ++k) {
    const Pieces::Piece& t = pieces[k];
    node.area += t.area;
    node.centre += t.size * t.middle;
    total += t.size;
    low = low.cwiseMin(t.middle);
    high = high.cwiseMax(t.middle);
  }
  node.centre = total > 0 ? Vec3(node.centre / total) : low;
  for (int k = first; k < last; ++k)
    for (const Vec3& p : pieces[k].corners) square = std::max(square, (p - node.centre).squaredNorm());
  node.radius = std::sqrt(square);
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const auto before = [&, axis](int i, int j) { return pieces.all[at(i)].sum[axis] < pieces.all[at(j)].sum[axis]; };
  const auto begin = pieces.order.begin();
  if (last - first > kGroupLeaf) std::nth_element(begin + first, begin + (first + last) / 2, begin + last, before);
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
