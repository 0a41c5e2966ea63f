// Surface pairs and random states for the tests of contact.
#pragma once

#include <memory>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "genu/contact/contact_equations.h"
#include "genu/surface/analytic.h"
#include "support/wrench_difference.h"

namespace genu::test {

struct NamedSurface {
  std::string name;
  std::unique_ptr<Surface> surface;
};

/// One of each kind of curvature, placed off its body's origin, about 20 mm in size.
inline std::vector<NamedSurface> some_surfaces() {
  const Pose tilted{exp_rotation({0.3, -0.2, 0.5}), {4e-3, -2e-3, 3e-3}};
  std::vector<NamedSurface> out;
  out.push_back({"plane", make_plane(tilted, false)});
  out.push_back({"sphere", make_sphere(tilted, 18e-3, false)});
  out.push_back({"socket", make_sphere(tilted, 31e-3, true)});
  out.push_back({"torus", make_torus(tilted, 15e-3, 5e-3, false)});
  out.push_back({"ellipsoid", make_ellipsoid(tilted, {15e-3, 20e-3, 27e-3}, false)});
  out.push_back(
      {"polynomial", make_polynomial(tilted, {{2, 0, 12}, {1, 1, 5}, {0, 2, -8}, {3, 0, 150}, {1, 2, -90}}, false)});
  return out;
}

inline Vec3 random_vector(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> unit(-1, 1);
  return reach * Vec3{unit(random), unit(random), unit(random)};
}

/// A point of the surface near a random place within `reach` of its body's origin.
inline SurfacePoint random_point(const Surface& surface, std::mt19937& random, double reach = 10e-3) {
  SurfacePoint out;
  for (int i = 0; i < 100; ++i)
    if (surface.project(random_vector(random, reach), out)) return out;
  ADD_FAILURE() << "no point found on the surface";
  return out;
}

/// The pose of b in a at which the given points touch, normals opposed, B turned about the common normal by `spin`.
inline Pose touching(const SurfacePoint& a, const SurfacePoint& b, double spin = 0) {
  Mat3 A, B;
  A << a.T, a.n;
  B << b.T.col(1), b.T.col(0), -b.n;
  const Mat3 R = A * exp_rotation({0, 0, spin}) * B.transpose();
  return {R, a.p - R * b.p};
}

}  // namespace genu::test
