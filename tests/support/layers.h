// Meshes and scenes for elastic layers, and the plain way to sum one: every ray against every triangle.
#pragma once

#include <cmath>
#include <optional>

#include "genu/contact/layer_quadrature.h"
#include "genu/contact/triangle_layer.h"
#include "genu/mesh/mesh.h"
#include "genu/surface/analytic.h"

namespace genu::test {

/// A ball round the origin, as triangles with edges of about `edge` (m).
inline Mesh ball(double radius, double edge) {
  return make_sphere({}, radius, false)->triangles(edge, Vec3::Zero(), 10 * radius);
}

/// A flat square sheet |x|, |y| <= half (m), outward +z, cut into n x n squares of two triangles each.
inline Mesh sheet(double half, int n) {
  Mesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.vertices.emplace_back(half * (2.0 * i / n - 1), half * (2.0 * j / n - 1), 0);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = i + j * (n + 1), b = a + 1, c = a + n + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

/// The nearest triangle that the ray comes out of, by looking at all of them (Moeller and Trumbore 1997).
inline TriangleTree::Hit leaving_by_all(const Mesh& mesh, const Vec3& o, const Vec3& d, double length) {
  TriangleTree::Hit best;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const auto& t = mesh.triangles[k];
    const auto v = [&](std::size_t i) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(t[i])]; };
    const Vec3 e1 = v(1) - v(0), e2 = v(2) - v(0), p = d.cross(e2), s = o - v(0), q = s.cross(e1);
    const double det = e1.dot(p);
    if (!(e1.cross(e2).dot(d) > 0)) continue;
    const double u = s.dot(p) / det, w = d.dot(q) / det, at = e2.dot(q) / det;
    if (u < 0 || w < 0 || u + w > 1 || !(at > 0) || at > length) continue;
    if (!best || at < best.distance) best = {static_cast<int>(k), at};
  }
  return best;
}

/// The same, and nothing where the ray enters before: along the ray turned round it would come out there.
inline TriangleTree::Hit overlap_by_all(const Mesh& mesh, const Vec3& o, const Vec3& d, double length) {
  const TriangleTree::Hit out = leaving_by_all(mesh, o, d, length);
  return out && leaving_by_all(mesh, o + out.distance * d, -d, out.distance) ? TriangleTree::Hit() : out;
}

/// Wrench on the casting body, summed over all its triangles by overlap_by_all().
inline Vec6 wrench_by_all(const Mesh& casting, const Mesh& target, const Pose& X_TC, double depth, const LayerLaw& law,
                          double thickness) {
  Vec6 wrench = Vec6::Zero();
  for (const auto& t : casting.triangles) {
    const auto v = [&](std::size_t i) -> const Vec3& { return casting.vertices[static_cast<std::size_t>(t[i])]; };
    const Vec3 area = 0.5 * (v(1) - v(0)).cross(v(2) - v(0)), x = (v(0) + v(1) + v(2)) / 3;
    const auto hit = overlap_by_all(target, X_TC * x, -(X_TC.R * area.normalized()), depth);
    if (!hit) continue;
    const Vec3 force = -law.at(hit.distance, thickness).p * area;
    wrench.head<3>() += force;
    wrench.tail<3>() += x.cross(force);
  }
  return wrench;
}

}  // namespace genu::test
