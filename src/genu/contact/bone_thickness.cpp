#include "genu/contact/bone_thickness.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace genu {
namespace {

constexpr double kUnknownThickness = std::numeric_limits<double>::infinity();

/// Area-weighted normals at the vertices; zero where undefined.
std::vector<Vec3> area_weighted_normals(const Mesh& mesh) {
  std::vector<Vec3> normals(mesh.vertices.size(), Vec3::Zero());
  for (const auto& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[at(t[0])];
    const Vec3 area = (mesh.vertices[at(t[1])] - a).cross(mesh.vertices[at(t[2])] - a);
    for (const int v : t) normals[at(v)] += area;
  }
  for (Vec3& n : normals) n = n.norm() > 0 ? Vec3(n.normalized()) : Vec3::Zero();
  return normals;
}

class BoneRays {
 public:
  explicit BoneRays(const BoneUnder& bone) : bone_(bone) {}

  /// The side of the bone that more rays meet becomes the outer one.
  void choose_side(const Mesh& mesh, const std::vector<Vec3>& normals) {
    int entered = 0, left = 0;
    for (std::size_t v = 0; v < normals.size(); ++v) {
      const TriangleTree::Hit in = bone_.triangles->entering(mesh.vertices[v], -normals[v], bone_.most);
      const TriangleTree::Hit out = bone_.triangles->leaving(mesh.vertices[v], -normals[v], bone_.most);
      if (in && (!out || in.distance < out.distance)) ++entered;
      if (out && (!in || out.distance < in.distance)) ++left;
    }
    turned_ = left > entered;
  }

  /// m, from x along the inward normal -n to the bone; negative where bone protrudes. Empty without bone.
  std::optional<double> measure(const Vec3& x, const Vec3& n) const {
    if (n.isZero(0)) return {};
    const TriangleTree& tree = *bone_.triangles;
    const auto down = turned_ ? tree.leaving(x, -n, bone_.most) : tree.entering(x, -n, bone_.most);
    if (down) return down.distance;
    const auto up = turned_ ? tree.entering(x, n, bone_.most) : tree.leaving(x, n, bone_.most);
    if (up) return -up.distance;
    return {};
  }

 private:
  const BoneUnder& bone_;
  bool turned_ = false;
};

/// Fills unknown values ring by ring from the known vertices, each as the mean of its neighbours in the ring before.
/// Parts of the mesh without a known vertex get `least`. Reports the distance (m, along edges) of the last ring.
void fill(const Mesh& mesh, double least, std::vector<double>& h, BoneReport& report) {
  std::vector<std::vector<int>> neighbours(h.size());
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      neighbours[at(t[k])].push_back(t[(k + 1) % 3]);
      neighbours[at(t[k])].push_back(t[(k + 2) % 3]);
    }
  std::vector<double> away(h.size(), kUnknownThickness);
  std::vector<int> ring;
  for (std::size_t v = 0; v < h.size(); ++v)
    if (h[v] < kUnknownThickness) away[v] = 0, ring.push_back(static_cast<int>(v));
  while (!ring.empty()) {
    std::vector<int> next;
    std::vector<double> found;
    for (const int v : ring)
      for (const int w : neighbours[at(v)])
        if (h[at(w)] == kUnknownThickness) next.push_back(w);
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    for (const int w : next) {
      double total = 0;
      int count = 0;
      for (const int v : neighbours[at(w)]) {
        if (h[at(v)] == kUnknownThickness) continue;
        total += h[at(v)];
        ++count;
        away[at(w)] = std::min(away[at(w)], away[at(v)] + (mesh.vertices[at(v)] - mesh.vertices[at(w)]).norm());
      }
      found.push_back(total / count);
    }
    for (std::size_t k = 0; k < next.size(); ++k) h[at(next[k])] = found[k];
    ring = std::move(next);
  }
  for (std::size_t v = 0; v < h.size(); ++v) {
    if (h[v] == kUnknownThickness) h[v] = least;
    if (away[v] <= report.farthest || neighbours[v].empty()) continue;
    report.farthest = away[v];
    report.farthest_place = mesh.vertices[v];
  }
}

}  // namespace

std::shared_ptr<const ThicknessField> measure_thickness(const Mesh& cartilage, const BoneUnder& bone,
                                                        BoneReport& report) {
  const std::vector<Vec3> normals = area_weighted_normals(cartilage);
  BoneRays rays(bone);
  rays.choose_side(cartilage, normals);
  std::vector<double> at_vertices(cartilage.vertices.size(), kUnknownThickness);
  report = {};
  report.vertices = static_cast<int>(at_vertices.size());
  report.thinnest = bone.least;
  for (std::size_t v = 0; v < at_vertices.size(); ++v) {
    const auto h = rays.measure(cartilage.vertices[v], normals[v]);
    if (!h) {
      ++report.without;
      continue;
    }
    at_vertices[v] = std::max(*h, bone.least);
    if (*h < bone.least) ++report.thin;
    if (*h < report.thinnest) report.thinnest = *h, report.thinnest_place = cartilage.vertices[v];
  }
  if (report.without == report.vertices) return nullptr;
  std::vector<bool> guessed;
  for (const double h : at_vertices) guessed.push_back(h == kUnknownThickness);
  fill(cartilage, bone.least, at_vertices, report);
  std::vector<double> at_centroids;
  at_centroids.reserve(cartilage.triangles.size());
  for (const auto& t : cartilage.triangles) {
    const Vec3 &a = cartilage.vertices[at(t[0])], &b = cartilage.vertices[at(t[1])], &c = cartilage.vertices[at(t[2])];
    const Vec3 area = (b - a).cross(c - a);
    const auto h = rays.measure((a + b + c) / 3, area.norm() > 0 ? Vec3(area.normalized()) : Vec3::Zero());
    const double mean = (at_vertices[at(t[0])] + at_vertices[at(t[1])] + at_vertices[at(t[2])]) / 3;
    at_centroids.push_back(h ? std::max(*h, bone.least) : mean);
  }
  return std::make_shared<const ThicknessField>(cartilage, std::move(at_vertices), std::move(at_centroids), guessed);
}

}  // namespace genu
