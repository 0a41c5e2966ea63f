// Curved bodies pressed into a plane by elastic layers, and what the layers carry by integrals over the exact shapes.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>

#include "genu/contact/elastic_layer.h"
#include "genu/contact/smooth_layer.h"
#include "genu/contact/triangle_layer.h"
#include "genu/surface/analytic.h"
#include "genu/surface/blend_surface.h"

namespace genu::layer_tests {

/// A body whose lowest point is its frame's origin, where its normal is -z: height over the tangent plane.
struct Bowl {
  std::string name;
  std::shared_ptr<const Surface> surface;
  std::function<double(double, double)> height;  ///< m
  std::function<Vec2(double, double)> slope;     ///< its gradient
  double size = 0;                               ///< m: twice the largest radius
};

inline Bowl sphere(double R) {
  return {"sphere", make_sphere({Mat3::Identity(), {0, 0, R}}, R, false),
          [R](double x, double y) { return R - std::sqrt(R * R - x * x - y * y); },
          [R](double x, double y) { return Vec2(Vec2(x, y) / std::sqrt(R * R - x * x - y * y)); }, 2 * R};
}

inline Bowl ellipsoid(double a, double b, double c) {
  const auto root = [=](double x, double y) { return std::sqrt(1 - x * x / (a * a) - y * y / (b * b)); };
  return {"ellipsoid", make_ellipsoid({Mat3::Identity(), {0, 0, c}}, {a, b, c}, false),
          [=](double x, double y) { return c - c * root(x, y); },
          [=](double x, double y) { return Vec2(c / root(x, y) * Vec2(x / (a * a), y / (b * b))); },
          2 * std::max({a, b, c})};
}

/// Its axis along y, seen on the outer equator: radii major + minor along x and minor along y.
inline Bowl torus(double major, double minor) {
  Mat3 R;
  R.col(0) = Vec3::UnitZ(), R.col(1) = Vec3::UnitX(), R.col(2) = Vec3::UnitY();
  const auto reach = [=](double y) { return major + std::sqrt(minor * minor - y * y); };
  const auto below = [=](double x, double y) { return std::sqrt(reach(y) * reach(y) - x * x); };
  return {
      "torus", make_torus({R, {0, 0, major + minor}}, major, minor, false),
      [=](double x, double y) { return major + minor - below(x, y); },
      [=](double x, double y) { return Vec2(Vec2(x, reach(y) * y / std::sqrt(minor * minor - y * y)) / below(x, y)); },
      2 * (major + minor)};
}

struct Carried {
  double force = 0, area = 0, peak = 0;  ///< N, m^2, m of depth
};

/// The mean of both castings at the depth delta (m), stiffness K (Pa/m): from the plane the depth is vertical, v, and
/// from the body it is v / |n_z| with the area element dx dy / |n_z|; so force and area are the integrals of
/// K v (1 + s) / 2 and (1 + s) / 2, s = 1 / |n_z|, or of K v s and s with `from_bowl` = 1, K v and 1 with 0. Gauss's
/// rule (12 points) along rays, the trapezoidal rule round.
inline Carried exact(const Bowl& bowl, double delta, double K, double from_bowl = 0.5) {
  constexpr int kRound = 128;
  constexpr double x[6] = {0.1252334085114689, 0.3678314989981802, 0.5873179542866175,
                           0.7699026741943047, 0.9041172563704749, 0.9815606342467192};
  constexpr double w[6] = {0.2491470458134028, 0.2334925365383548, 0.2031674267230659,
                           0.1600783285433462, 0.1069393259953184, 0.0471753363865118};
  Carried out{0, 0, delta};
  for (int k = 0; k < kRound; ++k) {
    const double angle = 2 * std::numbers::pi * k / kRound, c = std::cos(angle), s = std::sin(angle);
    double low = 0, high = 0.3 * bowl.size;
    while (bowl.height(high * c, high * s) != bowl.height(high * c, high * s)) high *= 0.9;
    for (int i = 0; i < 100; ++i) {
      const double mid = 0.5 * (low + high);
      (bowl.height(mid * c, mid * s) < delta ? low : high) = mid;
    }
    for (int i = 0; i < 6; ++i)
      for (const double sign : {-1.0, 1.0}) {
        const double r = 0.5 * low * (1 + sign * x[i]), weight = 0.5 * low * w[i] * r * 2 * std::numbers::pi / kRound;
        const double steep = std::sqrt(1 + bowl.slope(r * c, r * s).squaredNorm());
        const double share = 1 - from_bowl + from_bowl * steep;
        out.force += weight * share * K * (delta - bowl.height(r * c, r * s));
        out.area += weight * share;
      }
  }
  return out;
}

/// The bowl's own tessellation as a blend.
inline std::shared_ptr<const Surface> as_mesh(const Bowl& bowl, double edge) {
  Diagnostics diagnostics;
  return BlendSurface::build(bowl.surface->triangles(edge, Vec3::Zero(), bowl.size), {}, bowl.name, diagnostics);
}

struct Pressed {
  std::shared_ptr<const ElasticLayer> layer;
  int triangles = 0;  ///< of the bowl
};

/// Body a carries a plane of half width `reach`, facing up, b the surface; cut into triangles of this edge (m).
inline Pressed smooth(const std::shared_ptr<const Surface>& b, double edge, double reach, const LayerLaw& law,
                      double thickness, double search_depth, bool swap = false) {
  const std::shared_ptr<const Surface> a = make_plane({}, false);
  const Mesh mesh_a = a->triangles(edge, Vec3::Zero(), reach), mesh_b = b->triangles(edge, Vec3::Zero(), reach);
  const auto cells_a = std::make_shared<const SmoothCells>(mesh_a, a);
  const auto cells_b = std::make_shared<const SmoothCells>(mesh_b, b);
  const auto tree_a = std::make_shared<const TriangleTree>(mesh_a),
             tree_b = std::make_shared<const TriangleTree>(mesh_b);
  const LayerThickness both{thickness, nullptr, nullptr};
  const auto from_a =
      std::make_shared<const SmoothLayer>(SmoothDepths(cells_a, cells_b, tree_b, search_depth, law, both));
  const auto from_b =
      std::make_shared<const SmoothLayer>(SmoothDepths(cells_b, cells_a, tree_a, search_depth, law, both));
  return {
      std::make_shared<const ElasticLayer>(std::vector<ElasticLayer::Side>{{!swap, 0.5, from_a}, {swap, 0.5, from_b}}),
      static_cast<int>(mesh_b.triangles.size())};
}

/// The same between triangles, rays from those of the bowl or of the plane.
inline Pressed triangles(const std::shared_ptr<const Surface>& b, double edge, double reach, const LayerLaw& law,
                         double thickness, double search_depth, bool from_bowl) {
  const Mesh mesh_a = make_plane({}, false)->triangles(edge, Vec3::Zero(), reach);
  const Mesh mesh_b = b->triangles(edge, Vec3::Zero(), reach);
  const auto target = std::make_shared<const TriangleTree>(from_bowl ? mesh_a : mesh_b);
  const auto layer = std::make_shared<TriangleLayer>(from_bowl ? mesh_b : mesh_a, target, search_depth, law,
                                                     LayerThickness{thickness, nullptr, nullptr});
  return {std::make_shared<const ElasticLayer>(std::vector<ElasticLayer::Side>{{!from_bowl, 1.0, layer}}),
          static_cast<int>(mesh_b.triangles.size())};
}

inline Carried carried(const ElasticLayer& layer, const Pose& X_Wa, const Pose& X_Wb, int level = 0) {
  Carried out;
  ElasticLayer::Memory memory;
  LayerWrench wrench;
  layer.evaluate(X_Wa, X_Wb, memory, wrench, level);
  out.force = wrench.wrench.segment<3>(6).norm();
  for (std::size_t side = 0; side < layer.sides().size(); ++side)
    layer.visit(
        X_Wa, X_Wb, side, memory,
        [&](const LayerPoint& point) {
          out.area += layer.sides()[side].share * point.area;
          out.peak = std::max(out.peak, point.depth);
        },
        level);
  return out;
}

}  // namespace genu::layer_tests
