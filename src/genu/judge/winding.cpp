#include "genu/judge/winding.h"

#include <algorithm>
#include <map>

namespace genu::judge {
namespace {

struct OnEdge {
  int triangle;
  bool forward;  ///< from the lower vertex to the higher one
};

using Edges = std::map<std::pair<int, int>, std::vector<OnEdge>>;

Edges edges_of(const std::vector<std::array<int, 3>>& triangles) {
  Edges edges;
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = triangles[at(t)][k], b = triangles[at(t)][(k + 1) % 3];
      if (a != b) edges[std::minmax(a, b)].push_back({t, a < b});
    }
  return edges;
}

}  // namespace

void align_winding(const std::vector<Vec3>& vertices, std::vector<std::array<int, 3>>& triangles) {
  struct Neighbour {
    int triangle;
    bool alike;
  };
  std::vector<std::vector<Neighbour>> beside(triangles.size());
  for (const auto& [edge, on] : edges_of(triangles)) {
    if (on.size() != 2 || on[0].triangle == on[1].triangle) continue;
    const bool alike = on[0].forward != on[1].forward;
    beside[at(on[0].triangle)].push_back({on[1].triangle, alike});
    beside[at(on[1].triangle)].push_back({on[0].triangle, alike});
  }
  const auto area = [&](int t) {
    const auto& c = triangles[at(t)];
    return (vertices[at(c[1])] - vertices[at(c[0])]).cross(vertices[at(c[2])] - vertices[at(c[0])]).norm();
  };
  std::vector<int> turned(triangles.size(), -1);  // not visited, unchanged, turned
  for (int first = 0; first < static_cast<int>(triangles.size()); ++first) {
    if (turned[at(first)] >= 0) continue;
    std::vector<int> piece = {first};
    turned[at(first)] = 0;
    double kept = 0, changed = 0;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const int t = piece[i];
      (turned[at(t)] == 0 ? kept : changed) += area(t);
      for (const Neighbour& n : beside[at(t)]) {
        if (turned[at(n.triangle)] >= 0) continue;
        turned[at(n.triangle)] = n.alike ? turned[at(t)] : 1 - turned[at(t)];
        piece.push_back(n.triangle);
      }
    }
    for (const int t : piece)
      if ((turned[at(t)] == 1) == (changed <= kept)) std::swap(triangles[at(t)][1], triangles[at(t)][2]);
  }
}

void turn_closed_outward(const std::vector<Vec3>& vertices, std::vector<std::array<int, 3>>& triangles) {
  if (triangles.empty()) return;
  for (const auto& [edge, on] : edges_of(triangles))
    if (on.size() != 2) return;
  const Vec3 middle = vertices[at(triangles[0][0])];  // the sum does not depend on it; rounding does
  double six_volumes = 0;
  for (const auto& t : triangles)
    six_volumes += (vertices[at(t[0])] - middle).dot((vertices[at(t[1])] - middle).cross(vertices[at(t[2])] - middle));
  if (six_volumes < 0)
    for (auto& t : triangles) std::swap(t[1], t[2]);
}

}  // namespace genu::judge
