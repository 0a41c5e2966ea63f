#include "genu/mesh/coordinate_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "genu/mesh/tolerances.h"

namespace genu {
namespace {

/// Are all coordinates multiples of 1 / scale, to the relative precision `epsilon`?
bool are_multiples(const Mesh& mesh, double scale, double epsilon) {
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [&](const Vec3& v) {
    for (int k = 0; k < 3; ++k) {
      const double x = scale * v[k];
      if (std::abs(x - std::round(x)) > 2 * epsilon * std::abs(x)) return false;
    }
    return true;
  });
}

/// Is every triangle in a plane of constant x, y or z? A plate, a box or a voxel's faces have round numbers by design.
bool lies_along_axes(const Mesh& mesh) {
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
    const Vec3 &a = mesh.vertices[at(t[0])], &b = mesh.vertices[at(t[1])], &c = mesh.vertices[at(t[2])];
    return ((a.array() == b.array()) && (b.array() == c.array())).any();
  });
}

}  // namespace

CoordinateStep coordinate_step(const Mesh& mesh) {
  using Float = std::numeric_limits<float>;
  CoordinateStep out;
  bool single = true;
  double largest = 0;
  for (const Vec3& v : mesh.vertices) {
    largest = std::max(largest, v.cwiseAbs().maxCoeff());
    for (int k = 0; k < 3; ++k) single &= v[k] == static_cast<double>(static_cast<float>(v[k]));
  }
  if (single) {
    const auto most = static_cast<float>(largest);
    out.single = static_cast<double>(std::nextafter(most, Float::infinity())) - static_cast<double>(most);
  }
  if (lies_along_axes(mesh)) return out;
  const double epsilon = single ? double{Float::epsilon()} : std::numeric_limits<double>::epsilon();
  for (double scale = 1; epsilon * largest * scale < kDecimalStepMaxRounding && scale < 1e13; scale *= 10) {
    if (!are_multiples(mesh, scale, epsilon)) continue;
    out.decimal = 1 / scale;
    break;
  }
  return out;
}

}  // namespace genu
