// The torus that the blend's tests are held to, and short ways to build a blend.
#pragma once

#include <memory>

#include <gtest/gtest.h>

#include "genu/surface/blend_surface.h"
#include "support/blend_meshes.h"

namespace genu::test {

constexpr double kMajor = 15e-3, kMinor = 5e-3;

inline std::unique_ptr<BlendSurface> build(Mesh mesh, BlendOptions options = {}) {
  Diagnostics diagnostics;
  auto surface = BlendSurface::build(std::move(mesh), options, "surface", diagnostics);
  for (const Diagnostic& d : diagnostics.items()) ADD_FAILURE() << to_string(d);
  return surface;
}

inline BlendOptions fitted(double radius, int degree = 3) {
  BlendOptions options;
  options.fit_radius = radius;
  options.degree = degree;
  return options;
}

/// The point at the angles a (round z) and b (round the tube), `off` (m) outside the tube.
inline Vec3 torus_point(double a, double b, double off = 0) {
  const Vec3 out(std::cos(a), std::sin(a), 0);
  return kMajor * out + (kMinor + off) * (std::cos(b) * out + std::sin(b) * Vec3::UnitZ());
}

/// The shape operator in the body's frame, 1/m.
inline Mat3 tensor(const SurfacePoint& point) { return point.T * point.S * point.T.transpose(); }

}  // namespace genu::test
