// Irregular meshes of known shapes, the same on every run: vertices lie exactly on the shape unless noise is asked for.
#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <utility>

#include <Eigen/Geometry>

#include "genu/core/pose.h"
#include "genu/mesh/mesh.h"
#include "support/mesh_parts.h"

namespace genu::test {

constexpr double kTwoPi = 2 * std::numbers::pi;

/// A torus round z with edges of about `edge` (m): a staggered grid, every vertex shaken by up to 0.25 of a cell.
inline Mesh jittered_torus(double major, double minor, double edge, double noise = 0, unsigned seed = 7) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shake(-0.25, 0.25);
  std::normal_distribution<double> normal;
  const int nu = static_cast<int>(std::round(kTwoPi * major / edge));
  const int nv = 2 * static_cast<int>(std::round(kTwoPi * minor / (edge * std::sqrt(0.75)) / 2));
  Mesh mesh;
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      const double a = kTwoPi * (i + shake(random) + 0.5 * (j % 2)) / nu, b = kTwoPi * (j + shake(random)) / nv;
      const Vec3 n(std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b));
      mesh.vertices.push_back(major * Vec3(std::cos(a), std::sin(a), 0) + (minor + noise * normal(random)) * n);
    }
  }
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      const int a = j * nu + i, b = j * nu + (i + 1) % nu, up = (j + 1) % nv * nu;
      const int c = up + i, d = up + (i + 1) % nu;
      if (j % 2 == 0) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({b, d, c});
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({a, d, c});
      }
    }
  }
  return mesh;
}

/// z = height(x, y) over [-half, half]^2, shaken inside and straight along its edges; upward unless `flipped`.
inline Mesh jittered_patch(double half, double edge, const std::function<double(double, double)>& height,
                           bool flipped = false, unsigned seed = 3) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shake(-0.25, 0.25);
  const int n = static_cast<int>(std::round(2 * half / edge));
  Mesh mesh;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double sx = shake(random), sy = shake(random);
      const double x = 2 * half * (i + (i % n ? sx : 0)) / n - half, y = 2 * half * (j + (j % n ? sy : 0)) / n - half;
      mesh.vertices.emplace_back(x, y, height(x, y));
    }
  }
  const auto add = [&](int a, int b, int c) {
    mesh.triangles.push_back(flipped ? std::array{a, c, b} : std::array{a, b, c});
  };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      add(a, b, d);
      add(a, d, c);
    }
  }
  return mesh;
}

/// An icosahedron whose triangles are split `levels` times, blown up to a sphere with normal noise (m).
inline Mesh noisy_sphere(double radius, int levels, double noise, unsigned seed = 5) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  Mesh mesh;
  mesh.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [it, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<int>(mesh.vertices.size()));
      if (fresh) mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]).normalized());
      return it->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = finer;
  }
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (Vec3& v : mesh.vertices) v = (radius + noise * normal(random)) * v.normalized();
  return mesh;
}

}  // namespace genu::test
