#include "genu/surface/surface.h"

#include <cmath>
#include <limits>

#include "genu/surface/tolerances.h"

namespace genu {

Vec3 along_geodesic(const SurfacePoint& from, const Vec2& ds) {
  // Its first three derivatives: it bends along n by q, and n leans by -S ds as it goes.
  const Vec2 leans = from.S * ds;
  const double q = ds.dot(leans);
  return from.p + from.T * (ds - q / 6 * leans) + 0.5 * q * from.n;
}

bool Surface::retract(const SurfacePoint& from, const Vec2& ds, SurfacePoint& out) const {
  return project(along_geodesic(from, ds), out);
}

bool Surface::retract_roughly(const SurfacePoint& from, const Vec2& ds, SurfacePoint& out) const {
  return retract(from, ds, out);
}

std::optional<double> Surface::gap_and_foot(const Vec3& x, std::optional<SurfacePoint>& foot) const {
  foot.reset();
  return gap(x);
}

bool Surface::meet(const Vec3& origin, const Vec3& direction, double& t, Vec3& normal) const {
  SurfacePoint foot;
  for (int iteration = 0; iteration < kMaxRaySteps; ++iteration) {
    const Vec3 x = origin + t * direction;
    if (!project(x, foot)) return false;
    const double along = foot.n.dot(direction);
    if (!(std::abs(along) > kGrazingCosine)) return false;
    const double step = foot.n.dot(foot.p - x) / along;
    t += step;
    normal = foot.n;
    if (std::abs(step) <= kRaySettled) return true;
  }
  return false;
}

bool Surface::bending(const Vec3& x, const Vec3& t, Bending& out) const {
  SurfacePoint foot;
  if (!project(x, foot)) return false;
  const Vec2 along = foot.T.transpose() * t;
  out = {foot.n, along.dot(foot.S * along), foot.S.determinant()};
  return true;
}

double Surface::smooth_length() const { return std::numeric_limits<double>::infinity(); }

double Surface::edge_distance(const Vec3&) const { return std::numeric_limits<double>::infinity(); }

double Surface::clear_in_front(const Vec3&) const { return 0; }

SampleSet Surface::samples(double spacing, const Vec3& centre, double reach) const {
  return vertex_samples(triangles(spacing, centre, reach));
}

double box_diagonal(const Surface& surface, double edge) {
  const Mesh mesh = surface.triangles(edge, Vec3::Zero(), edge);
  if (mesh.vertices.empty()) return 0;
  Vec3 low = mesh.vertices.front(), high = low;
  for (const Vec3& v : mesh.vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
  return (high - low).norm();
}

Mat32 tangent_basis(const Vec3& n) {
  // Duff et al. 2017, "Building an orthonormal basis, revisited": no branch, no cancellation, right-handed.
  const double sign = std::copysign(1.0, n.z());
  const double a = -1 / (sign + n.z());
  const double b = n.x() * n.y() * a;
  Mat32 T;
  T.col(0) = Vec3(1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x());
  T.col(1) = Vec3(b, sign + n.y() * n.y() * a, -n.y());
  return T;
}

}  // namespace genu
