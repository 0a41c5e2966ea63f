#include "genu/mesh/solid_inertia.h"

#include <algorithm>
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

/// A closed piece of a mesh.
struct Piece {
  Mesh mesh;
  double volume = 0;  ///< m^3; negative where it faces inward
  BoundingBox box;
  WindingNumber winding;
};

std::vector<Piece> pieces_of(const Mesh& mesh, const Components& parts) {
  std::vector<Piece> pieces(at(parts.count));
  std::vector<int> place(mesh.vertices.size(), -1), owner(mesh.vertices.size(), -1);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    pieces[at(parts.of_triangle[i])].mesh.triangles.push_back(mesh.triangles[i]);
  for (int k = 0; k < parts.count; ++k) {
    Piece& piece = pieces[at(k)];
    for (auto& t : piece.mesh.triangles)
      for (int& v : t) {
        if (owner[at(v)] != k) {
          owner[at(v)] = k;
          place[at(v)] = static_cast<int>(piece.mesh.vertices.size());
          piece.mesh.vertices.push_back(mesh.vertices[at(v)]);
        }
        v = place[at(v)];
      }
    piece.volume = solid_inertia(piece.mesh).volume;
    piece.box = bounding_box(piece.mesh);
    if (parts.count > 1) piece.winding = WindingNumber(piece.mesh);
  }
  return pieces;
}

bool lies_in(const Piece& inner, const Piece& outer) {
  if (!((inner.box.low - outer.box.low).minCoeff() > 0 && (outer.box.high - inner.box.high).minCoeff() > 0))
    return false;
  return std::all_of(inner.mesh.vertices.begin(), inner.mesh.vertices.end(),
                     [&](const Vec3& v) { return std::abs(outer.winding(v)) > 0.5; });
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

OutwardReport turn_outward(Mesh& mesh) {
  const Components parts = connected_components(mesh);
  std::vector<Piece> pieces = pieces_of(mesh, parts);
  OutwardReport report;
  std::vector<bool> turned(pieces.size());
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    std::size_t around = 0;
    for (const Piece& other : pieces) around += &other != &pieces[k] && lies_in(pieces[k], other) ? 1 : 0;
    const bool cavity = around % 2 == 1;
    turned[k] = (pieces[k].volume < 0) != cavity;
    if (!turned[k]) continue;
    if (cavity)
      ++report.cavities, report.cavity_volume += pieces[k].volume;
    else
      report.turned += pieces[k].mesh.triangles.size();
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (turned[at(parts.of_triangle[i])]) std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
  return report;
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
