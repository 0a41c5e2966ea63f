// Shapes with known curvature, and irregular meshes of them, for the accuracy of the blend.
#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "genu/mesh/mesh.h"

namespace genu::test {

/// A shape as f = 0, outward where f grows, with derivatives; and as a map of a square of parameters, u x v facing out.
struct KnownShape {
  struct Value {
    double f;
    Vec3 gradient;
    Mat3 hessian;
  };
  std::string name;
  std::function<Value(const Vec3&)> value;
  std::function<Vec3(double, double)> map;  ///< of [0, 1]^2
  double width = 0, height = 0;             ///< m: of the square, about
  bool closed = false;                      ///< round in both parameters

  Vec3 normal(const Vec3& p) const { return value(p).gradient.normalized(); }
  /// 1/m, as a tensor in the shape's frame that is zero across.
  Mat3 curvature(const Vec3& p) const {
    const Value v = value(p);
    const Vec3 n = v.gradient.normalized();
    const Mat3 P = Mat3::Identity() - n * n.transpose();
    return -P * v.hessian * P / v.gradient.norm();
  }
};

inline KnownShape torus_shape(double major, double minor) {
  constexpr double kTurn = 2 * std::numbers::pi;
  KnownShape s{"torus", {}, {}, kTurn * major, kTurn * minor, true};
  s.value = [=](const Vec3& p) {
    const double q = std::hypot(p.x(), p.y());
    const Vec3 u(p.x() / q, p.y() / q, 0), t(-u.y(), u.x(), 0), z = Vec3::UnitZ();
    const Mat3 H = 2 * (u * u.transpose() + (1 - major / q) * t * t.transpose() + z * z.transpose());
    return KnownShape::Value{(q - major) * (q - major) + p.z() * p.z() - minor * minor,
                             2 * (q - major) * u + 2 * p.z() * z, H};
  };
  s.map = [=](double a, double b) {
    const Vec3 u(std::cos(kTurn * a), std::sin(kTurn * a), 0);
    return Vec3((major + minor * std::cos(kTurn * b)) * u + minor * std::sin(kTurn * b) * Vec3::UnitZ());
  };
  return s;
}

/// The belt of an ellipsoid, open at its poles.
inline KnownShape ellipsoid_shape(const Vec3& radii) {
  constexpr double kTurn = 2 * std::numbers::pi, kBelt = 1.2;  // rad to either side of the equator
  KnownShape s{"ellipsoid", {}, {}, 0.3 * kTurn * radii.x(), 2 * kBelt * radii.z(), false};
  s.value = [=](const Vec3& p) {
    const Vec3 inverse = radii.cwiseProduct(radii).cwiseInverse();
    const Mat3 H = 2 * Mat3(inverse.asDiagonal());
    return KnownShape::Value{p.dot(inverse.cwiseProduct(p)) - 1, 2 * inverse.cwiseProduct(p), H};
  };
  s.map = [=](double a, double b) {
    const double theta = 0.3 * kTurn * (a - 0.5), phi = kBelt * (2 * b - 1);
    return Vec3(
        radii.cwiseProduct(Vec3(std::cos(phi) * std::cos(theta), std::cos(phi) * std::sin(theta), std::sin(phi))));
  };
  return s;
}

/// z = sum c x^i y^j over a square about the origin, upward.
inline KnownShape height_shape(std::string name, double half,
                               std::vector<std::pair<std::array<int, 2>, double>> terms) {
  KnownShape s{std::move(name), {}, {}, 2 * half, 2 * half, false};
  const auto height = [=](double x, double y, int dx, int dy) {
    double sum = 0;
    for (const auto& [power, c] : terms) {
      if (power[0] < dx || power[1] < dy) continue;
      double term = c;
      for (int k = 0; k < dx; ++k) term *= power[0] - k;
      for (int k = 0; k < dy; ++k) term *= power[1] - k;
      sum += term * std::pow(x, power[0] - dx) * std::pow(y, power[1] - dy);
    }
    return sum;
  };
  s.value = [=](const Vec3& p) {
    const double x = p.x(), y = p.y();
    Mat3 H = Mat3::Zero();
    H(0, 0) = -height(x, y, 2, 0);
    H(1, 1) = -height(x, y, 0, 2);
    H(0, 1) = H(1, 0) = -height(x, y, 1, 1);
    return KnownShape::Value{p.z() - height(x, y, 0, 0), Vec3(-height(x, y, 1, 0), -height(x, y, 0, 1), 1), H};
  };
  s.map = [=](double a, double b) {
    const double x = half * (2 * a - 1), y = half * (2 * b - 1);
    return Vec3(x, y, height(x, y, 0, 0));
  };
  return s;
}

/// What is wrong with a mesh beside vertices that are shaken along the surface and diagonals drawn by lot.
enum class MeshFault { none, slivers, holes, two_faces };

/// A mesh of edges of about `edge` (m). Slivers: every fourth column stands a fortieth of an edge beside the last one.
/// Holes: one cell in 150 is missing, with half of another. Two faces: another sheet 2 mm behind, facing the other way.
inline Mesh irregular_mesh(const KnownShape& shape, double edge, MeshFault fault = MeshFault::none, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shake(-0.25, 0.25), lot(0, 1);
  const int nu = 4 * static_cast<int>(std::round(shape.width / edge / 4)),
            nv = static_cast<int>(std::round(shape.height / edge));
  const int columns = shape.closed ? nu : nu + 1, rows = shape.closed ? nv : nv + 1;
  Mesh mesh;
  for (int j = 0; j < rows; ++j) {
    double last = 0;
    for (int i = 0; i < columns; ++i) {
      const bool inner_u = shape.closed || (i > 0 && i < nu), inner_v = shape.closed || (j > 0 && j < nv);
      double u = i + (inner_u ? shake(random) : 0);
      const double v = j + (inner_v ? shake(random) : 0);
      if (fault == MeshFault::slivers && inner_u && i % 4 == 2) u = last + 1.0 / 40;
      last = u;
      mesh.vertices.push_back(shape.map(u / nu, v / nv));
    }
  }
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      const int up = (j + 1) % rows * columns, a = j * columns + i, b = j * columns + (i + 1) % columns, c = up + i,
                d = up + (i + 1) % columns;
      const bool hole = fault == MeshFault::holes && lot(random) < 1.0 / 150;
      const bool straight = lot(random) < 0.5;
      if (!hole) mesh.triangles.push_back(straight ? std::array{a, b, d} : std::array{a, b, c});
      if (!hole || lot(random) < 0.5) mesh.triangles.push_back(straight ? std::array{a, d, c} : std::array{b, d, c});
    }
  }
  if (fault != MeshFault::two_faces) return mesh;
  const std::size_t vertices = mesh.vertices.size(), triangles = mesh.triangles.size();
  for (std::size_t v = 0; v < vertices; ++v)
    mesh.vertices.push_back(mesh.vertices[v] - 2e-3 * shape.normal(mesh.vertices[v]));
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    const int n = static_cast<int>(vertices);
    mesh.triangles.push_back({a + n, c + n, b + n});
  }
  return mesh;
}

}  // namespace genu::test
