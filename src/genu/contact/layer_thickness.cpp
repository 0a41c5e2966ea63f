#include "genu/contact/layer_thickness.h"

#include <algorithm>

namespace genu {

ThicknessField::ThicknessField(const Mesh& mesh, std::vector<double> at_vertices, std::vector<double> at_centroids,
                               const std::vector<bool>& guessed)
    : at_vertices_(std::move(at_vertices)), at_centroids_(std::move(at_centroids)) {
  const bool given = !at_centroids_.empty();
  planes_.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[genu::at(t[0])];
    const Vec3 b = mesh.vertices[genu::at(t[1])] - a, c = mesh.vertices[genu::at(t[2])] - a, normal = b.cross(c);
    const double h = at_vertex(t[0]), to_b = at_vertex(t[1]) - h, to_c = at_vertex(t[2]) - h;
    const double size = normal.squaredNorm();
    const Vec3 gradient = size > 0 ? Vec3((to_b * c.cross(normal) + to_c * normal.cross(b)) / size) : Vec3::Zero();
    planes_.push_back({a, gradient, h, h + std::min({0.0, to_b, to_c}), h + std::max({0.0, to_b, to_c})});
    if (!given) at_centroids_.push_back(h + (to_b + to_c) / 3);
  }
  if (!guessed.empty())
    for (const auto& t : mesh.triangles)
      guessed_.push_back(guessed[genu::at(t[0])] || guessed[genu::at(t[1])] || guessed[genu::at(t[2])]);
  if (at_vertices_.empty()) return;
  const auto [low, high] = std::minmax_element(at_vertices_.begin(), at_vertices_.end());
  least_ = *low, most_ = *high;
  for (const double h : at_centroids_) least_ = std::min(least_, h), most_ = std::max(most_, h);
}

double ThicknessField::at(int triangle, const Vec3& x) const {
  const Plane& plane = planes_[static_cast<std::size_t>(triangle)];
  // Rounding may put x slightly outside the triangle: clamp to the range of all vertices.
  return std::clamp(plane.h + plane.gradient.dot(x - plane.corner), least_, most_);
}

double ThicknessField::within(int triangle, const Vec3& x) const {
  const Plane& plane = planes_[genu::at(triangle)];
  return std::clamp(plane.h + plane.gradient.dot(x - plane.corner), plane.low, plane.high);
}

}  // namespace genu
