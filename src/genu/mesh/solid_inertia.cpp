#include "genu/mesh/solid_inertia.h"

#include <cmath>
#include <numbers>

#include "genu/mesh/mesh_topology.h"
#include "genu/mesh/winding_number.h"

namespace genu {
namespace {

/// Integrals over the solid of 1, x and x x^T, x seen from `origin`.
struct Moments {
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
};

Moments moments_about(const Mesh& mesh, const Vec3& origin) {
  Moments m;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[at(t[0])] - origin;
    const Vec3 b = mesh.vertices[at(t[1])] - origin;
    const Vec3 c = mesh.vertices[at(t[2])] - origin;
    const double d = a.dot(b.cross(c));
    const Vec3 s = a + b + c;
    m.volume += d / 6;
    m.first += d / 24 * s;
    m.second += d / 120 * (s * s.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
  }
  return m;
}

}  // namespace

SolidInertia solid_inertia(const Mesh& mesh) {
  SolidInertia out;
  for (const Vec3& v : mesh.vertices) out.centroid += v / static_cast<double>(mesh.vertices.size());
  const Moments rough = moments_about(mesh, out.centroid);
  out.volume = rough.volume;
  if (!(std::abs(rough.volume) > 0)) return out;
  out.centroid += rough.first / rough.volume;
  // About the centroid itself nothing is left to be subtracted but what rounding put there.
  const Moments m = moments_about(mesh, out.centroid);
  const Vec3 left = m.first / m.volume;
  const Mat3 second = m.second - m.volume * left * left.transpose();
  out.volume = m.volume;
  out.about_centroid = second.trace() * Mat3::Identity() - second;
  return out;
}

std::size_t turn_outward(Mesh& mesh) {
  const Components parts = connected_components(mesh);
  std::vector<Mesh> pieces(at(parts.count));
  for (Mesh& piece : pieces) piece.vertices = mesh.vertices;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    pieces[at(parts.of_triangle[i])].triangles.push_back(mesh.triangles[i]);
  Mesh outward = mesh;
  outward.triangles.clear();
  std::vector<bool> inward(pieces.size());
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    inward[k] = solid_inertia(pieces[k]).volume < 0;
    if (!inward[k])
      outward.triangles.insert(outward.triangles.end(), pieces[k].triangles.begin(), pieces[k].triangles.end());
  }
  const WindingNumber winding(outward);
  std::size_t turned = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::size_t k = at(parts.of_triangle[i]);
    const int corner = pieces[k].triangles.front()[0];
    if (!inward[k] || (!outward.empty() && winding.inside(mesh.vertices[at(corner)]))) continue;
    std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
    ++turned;
  }
  return turned;
}

double fullness(const Mesh& mesh, double volume) {
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[at(t[0])];
    area += 0.5 * (mesh.vertices[at(t[1])] - a).cross(mesh.vertices[at(t[2])] - a).norm();
  }
  return area > 0 ? 6 * std::sqrt(std::numbers::pi) * std::abs(volume) / std::pow(area, 1.5) : 0;
}

}  // namespace genu
