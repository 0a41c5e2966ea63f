// Plain twins of the searches for contact: every triangle, every sample.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "genu/surface/surface.h"

namespace genu::test {

/// How often a closed mesh winds round x: 1 inside, 0 outside (solid angles, van Oosterom and Strackee 1983).
inline double winding_number(const Mesh& mesh, const Vec3& x) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const auto v = [&](std::size_t k) { return Vec3(mesh.vertices[static_cast<std::size_t>(t[k])] - x); };
    const Vec3 a = v(0), b = v(1), c = v(2);
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4 * M_PI);
}

/// Samples of a surface (frame s) lower over `queried` (frame q) than all their neighbours, and by how much: the local
/// minima of the gap as a grid sees them.
struct GridMinimum {
  Vec3 point;  ///< in frame s
  double gap;
};
inline std::vector<GridMinimum> grid_minima(const Surface& queried, const SampleSet& samples, const Pose& X_qs,
                                            double window) {
  std::vector<double> gaps;
  for (const Vec3& p : samples.points)
    gaps.push_back(queried.gap(X_qs * p).value_or(std::numeric_limits<double>::infinity()));
  std::vector<GridMinimum> out;
  for (int i = 0; i < samples.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!(gaps[k] < window)) continue;
    bool lowest = true;
    for (int n = samples.first_neighbour[k]; n < samples.first_neighbour[k + 1]; ++n)
      lowest = lowest && gaps[static_cast<std::size_t>(samples.neighbours[static_cast<std::size_t>(n)])] > gaps[k];
    if (lowest) out.push_back({samples.points[k], gaps[k]});
  }
  return out;
}

}  // namespace genu::test
