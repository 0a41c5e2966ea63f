#include "genu/contact/buried.h"

#include <algorithm>

#include "genu/contact/tolerances.h"

namespace genu {
namespace {

std::vector<Vec3> box_corners(const Mesh& mesh) {
  if (mesh.vertices.empty()) return {};
  Vec3 low = mesh.vertices[0], high = low;
  for (const Vec3& v : mesh.vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k)
    corners.emplace_back((k & 1) != 0 ? high.x() : low.x(), (k & 2) != 0 ? high.y() : low.y(),
                         (k & 4) != 0 ? high.z() : low.z());
  return corners;
}

double size_of(const std::vector<Vec3>& box) { return box.empty() ? 0 : (box.back() - box.front()).norm(); }

/// From the centroids of some triangles, spread over the order of the mesh and so over its surface.
std::vector<Ray> rays_of(const Mesh& mesh) {
  std::vector<Ray> rays;
  const std::size_t stride = 1 + mesh.triangles.size() / kMaxBuriedRays;
  for (std::size_t k = stride / 2; k < mesh.triangles.size(); k += stride) {
    const auto v = [&](std::size_t i) -> const Vec3& {
      return mesh.vertices[static_cast<std::size_t>(mesh.triangles[k][i])];
    };
    const Vec3 area = (v(1) - v(0)).cross(v(2) - v(0));
    if (area.norm() > 0) rays.push_back({(v(0) + v(1) + v(2)) / 3, -area.normalized()});
  }
  return rays;
}

}  // namespace

Buried::Buried(const Triangles& a, const Triangles& b, double depth) : depth_(depth) {
  corners_ = box_corners(*b.mesh);
  const double reach = size_of(box_corners(*a.mesh)) + size_of(corners_);
  a_ = {rays_of(*a.mesh), b.tree, reach};
  b_ = {rays_of(*b.mesh), a.tree, reach};
}

double Buried::Side::deepest(const Pose& X_TC, double depth) const {
  double deepest = 0;
  for (const Ray& ray : rays) {
    const Vec3 origin = X_TC * ray.origin, direction = X_TC.R * ray.direction;
    const TriangleTree::Hit out = other->leaving(origin, direction, reach);
    if (!out || out.distance <= std::max(depth, deepest)) continue;
    // A ray that enters before it leaves started outside.
    if (!other->entering(origin, direction, out.distance)) deepest = out.distance;
  }
  return deepest;
}

/// m: upper bound of the motion of any point of b relative to a; the corners of a box move farthest.
double Buried::motion(const Pose& from, const Pose& to) const {
  double farthest = 0;
  for (const Vec3& p : corners_) farthest = std::max(farthest, (from * p - to * p).norm());
  return farthest;
}

double Buried::deepest(const Pose& X_ab, Memory& memory) const {
  if (memory.known && motion(memory.shallow, X_ab) < 0.5 * depth_) return 0;
  const double found = std::max(a_.deepest(X_ab.inverse(), 0.5 * depth_), b_.deepest(X_ab, 0.5 * depth_));
  memory = {X_ab, found == 0};
  return found > depth_ ? found : 0;
}

}  // namespace genu
