#include "genu/mesh_care/mesh_damage.h"

#include <array>
#include <map>
#include <random>
#include <utility>

#include <Eigen/Geometry>

#include "genu/core/pose.h"
#include "genu/mesh/mesh_topology.h"

namespace genu {
namespace {

constexpr std::array<const char*, 15> kDamageNames = {"fin",   "flipped",    "duplicate",  "hole",   "crossing",
                                                      "stray", "spike",      "slivers",    "noise",  "shift",
                                                      "scale", "inside_out", "degenerate", "single", "subdivide"};

constexpr double kDamageMillimetre = 1e-3;  // m

/// A deviate of mean 0 and variance 1, the same with every standard library.
class Deviates {
 public:
  double next() {
    double sum = -6;  // twelve uniform ones: normal to well within what noise of a scanner is
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(engine_()) / 4294967296.0;
    return sum;
  }

 private:
  std::mt19937 engine_{12345};
};

Mesh subdivided(const Mesh& mesh) {
  Mesh out;
  out.vertices = mesh.vertices;
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int i, int j) {
    const auto [found, is_new] = middles.try_emplace(std::minmax(i, j), static_cast<int>(out.vertices.size()));
    if (is_new)
      out.vertices.push_back(
          Vec3(0.5 * (mesh.vertices[static_cast<std::size_t>(i)] + mesh.vertices[static_cast<std::size_t>(j)])));
    return found->second;
  };
  for (const auto& t : mesh.triangles) {
    const int a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
    for (const auto& part : {std::array{t[0], a, c}, {a, t[1], b}, {c, b, t[2]}, {a, b, c}})
      out.triangles.push_back(part);
  }
  return out;
}

}  // namespace

const char* to_string(MeshDamage damage) { return kDamageNames.at(static_cast<std::size_t>(damage)); }

std::optional<MeshDamage> mesh_damage_named(const std::string& name) {
  for (std::size_t k = 0; k < kDamageNames.size(); ++k)
    if (name == kDamageNames.at(k)) return static_cast<MeshDamage>(k);
  return std::nullopt;
}

int nearest_vertex(const Mesh& mesh, const Vec3& place) {
  int nearest = 0;
  for (int v = 1; v < static_cast<int>(mesh.vertices.size()); ++v)
    if ((mesh.vertices[static_cast<std::size_t>(v)] - place).norm() <
        (mesh.vertices[static_cast<std::size_t>(nearest)] - place).norm())
      nearest = v;
  return nearest;
}

std::vector<std::size_t> triangles_near(const Mesh& mesh, const Vec3& place, double radius) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Vec3 middle = Vec3::Zero();
    for (const int v : mesh.triangles[i]) middle += mesh.vertices[static_cast<std::size_t>(v)] / 3;
    if ((middle - place).norm() < radius) out.push_back(i);
  }
  return out;
}

Mesh damaged_near(Mesh mesh, MeshDamage damage, const Vec3& place, double radius) {
  const int v = nearest_vertex(mesh, place);
  const Vec3 p = mesh.vertices[static_cast<std::size_t>(v)];
  const Vec3 n = vertex_normals(mesh)[static_cast<std::size_t>(v)];
  const std::vector<std::size_t> near = triangles_near(mesh, p, radius);
  const int fresh = static_cast<int>(mesh.vertices.size());
  switch (damage) {
    case MeshDamage::fin:
      for (const std::size_t i : near) {
        const auto t = mesh.triangles[i];
        mesh.triangles.push_back({t[0], t[1], static_cast<int>(mesh.vertices.size())});
        mesh.vertices.push_back(Vec3(mesh.vertices[static_cast<std::size_t>(t[0])] + 0.5 * radius * n));
      }
      break;
    case MeshDamage::flipped:
      for (const std::size_t i : near) std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
      break;
    case MeshDamage::duplicate:
      for (const std::size_t i : near) mesh.triangles.push_back(std::array<int, 3>(mesh.triangles[i]));
      break;
    case MeshDamage::hole: {
      std::vector<char> gone(mesh.triangles.size(), 0);
      for (const std::size_t i : near) gone[i] = 1;
      std::size_t index = 0;
      std::erase_if(mesh.triangles, [&](const auto&) { return gone[index++] != 0; });
      break;
    }
    case MeshDamage::crossing: {
      const Mat3 tilt = exp_rotation(0.7 * n.unitOrthogonal());
      for (const std::size_t i : near) {
        const auto t = mesh.triangles[i];
        const int first = static_cast<int>(mesh.vertices.size());
        for (const int w : t)
          mesh.vertices.push_back(Vec3(p + tilt * (mesh.vertices[static_cast<std::size_t>(w)] - p)));
        mesh.triangles.push_back({first, first + 1, first + 2});
      }
      break;
    }
    case MeshDamage::stray: {
      const Vec3 c = p + 0.6 * radius * n;
      const double s = 0.3 * radius;
      for (int k = 0; k < 3; ++k) {
        mesh.vertices.push_back(Vec3(c + s * Vec3::Unit(k)));
        mesh.vertices.push_back(Vec3(c - s * Vec3::Unit(k)));
      }
      for (const auto& t :
           {std::array{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}})
        mesh.triangles.push_back({fresh + t[0], fresh + t[1], fresh + t[2]});
      break;
    }
    case MeshDamage::spike:
      mesh.vertices[static_cast<std::size_t>(v)] += radius * n;
      break;
    case MeshDamage::slivers:
      // A point very near a corner of each triangle, joined to all three corners.
      for (const std::size_t i : near) {
        const auto t = mesh.triangles[i];
        const auto corner = [&](std::size_t k) -> Vec3 { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
        const int w = static_cast<int>(mesh.vertices.size());
        mesh.vertices.push_back(Vec3(0.98 * corner(0) + 0.01 * corner(1) + 0.01 * corner(2)));
        mesh.triangles[i] = {t[0], t[1], w};
        mesh.triangles.push_back({t[1], t[2], w});
        mesh.triangles.push_back({t[2], t[0], w});
      }
      break;
    default:
      break;
  }
  return mesh;
}

Mesh damaged(Mesh mesh, MeshDamage damage, double size, const Vec3& shift) {
  Deviates deviates;
  switch (damage) {
    case MeshDamage::noise:
      for (Vec3& v : mesh.vertices)
        for (int k = 0; k < 3; ++k) v[k] += size * deviates.next();
      break;
    case MeshDamage::shift:
      for (Vec3& v : mesh.vertices) v += shift;
      break;
    case MeshDamage::scale:
      for (Vec3& v : mesh.vertices) v *= size;
      break;
    case MeshDamage::inside_out:
      for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
      break;
    case MeshDamage::degenerate: {
      const std::size_t count = mesh.triangles.size();
      for (std::size_t i = 0; i < count; i += 10) {
        const auto t = mesh.triangles[i];
        mesh.triangles.push_back({t[0], t[1], t[1]});
      }
      break;
    }
    case MeshDamage::single:
      for (Vec3& v : mesh.vertices)
        for (int k = 0; k < 3; ++k)
          v[k] = static_cast<double>(static_cast<float>(v[k] / kDamageMillimetre)) * kDamageMillimetre;
      break;
    case MeshDamage::subdivide:
      for (int k = 0; k < static_cast<int>(size); ++k) mesh = subdivided(mesh);
      break;
    default:
      break;
  }
  return mesh;
}

}  // namespace genu
