#include "hard_cases/population/shape_mesh.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <functional>

#include <Eigen/Geometry>

#include "hard_cases/population/random_source.h"

namespace genu::population {
namespace {

constexpr double kPi = std::numbers::pi;

/// A grid of m x n cells; where a direction closes, its last row is its first.
Triangles grid(int m, int n, bool close_m, bool close_n, const std::function<Vec3(double, double)>& at) {
  Triangles out;
  const int rows = close_m ? m : m + 1, columns = close_n ? n : n + 1;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) out.vertices.push_back(at(double(i) / m, double(j) / n));
  const auto index = [&](int i, int j) { return (i % rows) * columns + j % columns; };
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = index(i, j), b = index(i + 1, j), c = index(i + 1, j + 1), d = index(i, j + 1);
      if ((i + j) % 2 == 0) {
        out.faces.push_back({a, b, c});
        out.faces.push_back({a, c, d});
      } else {
        out.faces.push_back({a, b, d});
        out.faces.push_back({b, c, d});
      }
    }
  return out;
}

int cells(double length, double edge) { return std::max(4, static_cast<int>(std::lround(length / edge))); }

Triangles torus(double R, double r, double edge) {
  const int around = cells(2 * kPi * R, edge), tube = 2 * cells(kPi * r, edge);
  return grid(2 * (around / 2), tube, true, true, [=](double u, double v) {
    const double phi = 2 * kPi * u, theta = 2 * kPi * v, rho = R + r * std::cos(theta);
    return Vec3(rho * std::cos(phi), rho * std::sin(phi), r * std::sin(theta));
  });
}

/// The unit cube's faces pushed onto the ellipsoid.
Triangles ellipsoid(const Vec3& radii, double edge) {
  Triangles out;
  const int n = cells(radii.mean() * kPi / 2, edge);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Triangles face = grid(n, n, false, false, [&](double u, double v) {
        Vec3 p;
        p[axis] = side;
        p[(axis + 1) % 3] = std::tan((2 * u - 1) * kPi / 4);
        p[(axis + 2) % 3] = std::tan((2 * v - 1) * kPi / 4);
        return Vec3(radii.cwiseProduct(p.normalized()));
      });
      const int first = static_cast<int>(out.vertices.size());
      for (auto& f : face.faces) {
        for (int& k : f) k += first;
        if (side < 0) std::swap(f[1], f[2]);
        out.faces.push_back(f);
      }
      out.vertices.insert(out.vertices.end(), face.vertices.begin(), face.vertices.end());
    }
  return out;  // the cube's edges stand there twice: a reader of STL joins them
}

double height(const Shape& shape, double u, double v) {
  double sum = 0;
  for (const Shape::Term& t : shape.terms) sum += t.c * std::pow(u, t.i) * std::pow(v, t.j);
  return sum;
}

/// From low to high theta and z, outward away from the axis.
Triangles cylindrical(const Shape& shape, double half_width, double edge) {
  const double low = -135 * kPi / 180, high = 45 * kPi / 180, r = shape.terms.front().c;
  return grid(cells(r * (high - low), edge), cells(2 * half_width, edge), false, false, [&](double u, double v) {
    const double theta = low + (high - low) * u, z = half_width * (2 * v - 1), radius = height(shape, theta, z);
    return Vec3(radius * std::cos(theta), radius * std::sin(theta), z);
  });
}

Triangles sheet(const Shape& shape, double half_x, double half_y, double edge) {
  return grid(cells(2 * half_x, edge), cells(2 * half_y, edge), false, false, [&](double u, double v) {
    const double x = half_x * (2 * u - 1), y = half_y * (2 * v - 1);
    return Vec3(x, y, height(shape, x, y));
  });
}

/// One vertex at one place moves once, wherever it is listed.
void add_noise(Triangles& mesh, double noise, std::uint64_t seed) {
  std::vector<Vec3> normals(mesh.vertices.size(), Vec3::Zero());
  for (const auto& f : mesh.faces) {
    const Vec3 n = (mesh.vertices[std::size_t(f[1])] - mesh.vertices[std::size_t(f[0])])
                       .cross(mesh.vertices[std::size_t(f[2])] - mesh.vertices[std::size_t(f[0])]);
    for (const int k : f) normals[std::size_t(k)] += n;
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    std::uint64_t place = seed;
    for (int k = 0; k < 3; ++k)
      place = place * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(std::llround(1e4 * mesh.vertices[i][k]));
    RandomSource random(place, 0);
    mesh.vertices[i] += noise * random.normal() * normals[i].normalized();
  }
}

}  // namespace

Triangles shape_mesh(const Shape& shape, double size_x, double size_y, std::uint64_t noise_seed) {
  Triangles out;
  const double edge = shape.mesh_edge;
  if (shape.kind == Shape::Kind::torus) out = torus(shape.radii.x(), shape.radii.y(), edge);
  if (shape.kind == Shape::Kind::ellipsoid || shape.kind == Shape::Kind::sphere) out = ellipsoid(shape.radii, edge);
  if (shape.kind == Shape::Kind::cylindrical) out = cylindrical(shape, size_x, edge);
  if (shape.kind == Shape::Kind::polynomial) out = sheet(shape, size_x, size_y, edge);
  if (shape.noise > 0) add_noise(out, shape.noise, noise_seed);
  return out;
}

void write_binary_stl(const Triangles& mesh, const std::string& path) {
  std::ofstream out(path, std::ios::binary);
  char header[80] = "random knee";
  out.write(header, sizeof header);
  const auto count = static_cast<std::uint32_t>(mesh.faces.size());
  out.write(reinterpret_cast<const char*>(&count), 4);
  for (const auto& f : mesh.faces) {
    float numbers[12] = {0, 0, 0};
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i)
        numbers[3 + 3 * k + i] = static_cast<float>(mesh.vertices[std::size_t(f[std::size_t(k)])][i]);
    char bytes[50] = {};
    std::memcpy(bytes, numbers, sizeof numbers);
    out.write(bytes, sizeof bytes);
  }
}

}  // namespace genu::population
