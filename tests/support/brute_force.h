// Plain twins of the searches for contact: every triangle, every sample.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "genu/surface/surface.h"

namespace genu::test {

/// The point of the triangle (a, b, c) nearest to x (Ericson 2005, section 5.1.5).
inline Vec3 nearest_on_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
  const double d1 = ab.dot(ax), d2 = ac.dot(ax), d3 = ab.dot(bx), d4 = ac.dot(bx), d5 = ab.dot(cx), d6 = ac.dot(cx);
  if (d1 <= 0 && d2 <= 0) return a;
  if (d3 >= 0 && d4 <= d3) return b;
  if (d6 >= 0 && d5 <= d6) return c;
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  return a + (vb * ab + vc * ac) / (va + vb + vc);
}

inline Vec3 nearest_on_mesh(const Mesh& mesh, const Vec3& x) {
  double least = std::numeric_limits<double>::infinity();
  Vec3 best = Vec3::Zero();
  for (const auto& t : mesh.triangles) {
    const auto v = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    const Vec3 p = nearest_on_triangle(x, v(0), v(1), v(2));
    if ((x - p).squaredNorm() >= least) continue;
    least = (x - p).squaredNorm();
    best = p;
  }
  return best;
}

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
