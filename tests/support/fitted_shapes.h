// Meshes of known shapes for tests of fits.
#pragma once

#include <cmath>
#include <random>

#include "genu/mesh/mesh.h"
#include "genu/shape_fit/chart_mesh.h"

namespace genu::test {

/// A plateau: terms of degree 4, mm made m.
inline std::vector<PolynomialTerm> plateau_terms() {
  return {{0, 0, 0},    {2, 0, 6},    {1, 1, -2},   {0, 2, 11},   {3, 0, 90},
          {1, 2, -150}, {4, 0, 3000}, {2, 2, 4000}, {0, 4, -2500}};
}

/// A condyle about its axis z: r in m over theta and z.
inline std::vector<PolynomialTerm> condyle_terms() {
  return {{0, 0, 0.021}, {1, 0, -0.0012}, {2, 0, -0.0016}, {0, 1, 0.02}, {1, 1, -0.05},
          {0, 2, -18},   {3, 0, 0.0004},  {2, 1, 0.04},    {2, 2, 3}};
}

/// A turned and shifted frame.
inline Pose some_frame() { return {exp_rotation(Vec3(0.4, -0.9, 0.3)), Vec3(0.012, -0.031, 0.008)}; }

/// Noise of `sigma` (m) along the normals, white: the same for the same seed.
inline void add_noise(Mesh& mesh, const Vec3& along, double sigma, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, sigma);
  for (Vec3& v : mesh.vertices) v += normal(random) * along;
}

}  // namespace genu::test
