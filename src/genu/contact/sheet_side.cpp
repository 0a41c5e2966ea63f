#include "genu/contact/sheet_side.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "genu/contact/tolerances.h"
#include "genu/mesh/mesh_topology.h"

namespace genu {
namespace {

/// What the winding number ranges over: away from the sheet it is a harmonic function, largest and smallest at the
/// sheet itself. Seen from both sides of the middles of some triangles; another sheet may be just behind.
SheetSide::Range range_of(const WindingNumber& winding, const Mesh& mesh) {
  const std::size_t count = mesh.triangles.size(), stride = std::max<std::size_t>(count / kWindingsAtSheet, 1);
  double low = 0, high = 0;
  for (std::size_t t = 0; t < count; t += stride) {
    const auto corner = [&](std::size_t k) -> const Vec3& { return mesh.vertices[at(mesh.triangles[t][k])]; };
    const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    const Vec3 off = kBesideSheet / std::sqrt(normal.norm()) * normal;
    const Vec3 middle = (corner(0) + corner(1) + corner(2)) / 3;
    for (const double side : {winding(middle - off), winding(middle + off)}) {
      high = std::max(high, side);
      low = std::min(low, side);
    }
  }
  return {0.5 * (low + high), kWindingReserve * 0.5 * (high - low)};
}

/// The largest value that a harmonic function between -1 and 1 in a unit ball can have at the distance q from its
/// middle, where it is `a` (B. Burgeth, A Schwarz lemma for harmonic and hyperbolic-harmonic functions in higher
/// dimensions, Manuscripta Math. 77, 1992): that of the function that is 1 on a cap of the sphere and -1 on the rest,
/// on its axis.
double harmonic_bound(double a, double q) {
  return (1 - q * q) / q * (1 / (1 - q) - 1 / std::sqrt(1 + 2 * a * q + q * q)) - 1;
}

/// How far a point may go (m) until its winding number can reach kBehindEdgeWinding: the surface is `distance` away.
double same_side(double winding, const SheetSide::Range& range, double distance) {
  const double here = std::max(-1.0, (winding + kWindingError - range.middle) / range.half),
               there = (kBehindEdgeWinding - kWindingError - range.middle) / range.half;
  if (!(here < there)) return 0;
  double low = 0, high = 1;
  for (int k = 0; k < kSameSideHalvings; ++k) {
    const double q = 0.5 * (low + high);
    (harmonic_bound(here, q) < there ? low : high) = q;
  }
  return low * distance;
}

/// How far a point in front of the inside of a sheet may go until the edge is nearest to it: it gets behind only beyond
/// that. On the way it comes no nearer to the edge, and no farther from the sheet, than it goes. (Not between parts of
/// a sheet of which one looks at the back of another, as of a scroll: halfway a point changes from front to back.)
double until_the_edge(double to_edge, double to_sheet) { return std::max(0.0, 0.5 * (to_edge - to_sheet)); }

/// How far a point beyond an edge may go (m) until it is behind the sheet itself, which tells its side: to the plane
/// that stands on the edge. Faces beside the edge have other normals than it. Infinite where it is well in front.
double over_the_edge(const Vec3& away, const Vec3& normal) {
  const double height = away.dot(normal), turned = kEdgeTurn * away.norm();
  if (height > turned) return std::numeric_limits<double>::infinity();
  return std::max(0.0, (away - height * normal).norm() - turned);
}

/// Whether the boxes of any two pieces overlap.
bool pieces_may_meet(const Mesh& mesh) {
  const Components parts = connected_components(mesh);
  if (parts.count < 2 || parts.count > kMaxPiecesCompared) return parts.count > 1;
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<Vec3> low(static_cast<std::size_t>(parts.count), Vec3::Constant(infinity)), high(low.size(), -low[0]);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const int v : mesh.triangles[t]) {
      const auto part = static_cast<std::size_t>(parts.of_triangle[t]);
      low[part] = low[part].cwiseMin(mesh.vertices[static_cast<std::size_t>(v)]);
      high[part] = high[part].cwiseMax(mesh.vertices[static_cast<std::size_t>(v)]);
    }
  for (std::size_t i = 0; i < low.size(); ++i)
    for (std::size_t j = i + 1; j < low.size(); ++j)
      if ((low[i].array() <= high[j].array()).all() && (low[j].array() <= high[i].array()).all()) return true;
  return false;
}

}  // namespace

EdgeDistance::EdgeDistance(const Mesh& mesh, const FeatureNormals& normals) {
  std::vector<Vec3> all;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (normals.open_vertex(v)) all.push_back(mesh.vertices[v]);
  const double apart = bounding_box({all, {}}).diagonal() / kEdgePointsAcross;
  for (const Vec3& p : all)
    if (!(square_to(p) < apart * apart)) points_.push_back(p);
  double longest = 0;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      longest = std::max(longest, (mesh.vertices[at(t[k])] - mesh.vertices[at(t[(k + 1) % 3])]).squaredNorm());
  cover_ = apart + 0.5 * std::sqrt(longest);
}

double EdgeDistance::square_to(const Vec3& x) const {
  double square = std::numeric_limits<double>::infinity();
  for (const Vec3& p : points_) square = std::min(square, (p - x).squaredNorm());
  return square;
}

double EdgeDistance::operator()(const Vec3& x) const { return std::sqrt(square_to(x)) - cover_; }

std::optional<SheetSide> SheetSide::of(const Mesh& mesh, const FeatureNormals& normals) {
  SheetSide out;
  out.entangled_ = pieces_may_meet(mesh);
  if (!normals.any_open() && !out.entangled_) return std::nullopt;
  if (normals.any_open()) out.edge_.emplace(mesh, normals);
  out.winding_ = std::make_shared<const WindingNumber>(mesh);
  out.range_ = range_of(*out.winding_, mesh);
  return out;
}

double SheetSide::at(const Vec3& x, const Vec3& away, const Vec3& normal, bool open, double& side) const {
  const double distance = away.norm();
  const double inside = open || entangled_ ? 0 : until_the_edge((*edge_)(x), distance);
  if (inside >= distance) return inside;
  const double winding = (*winding_)(x);
  const bool behind = open && !entangled_ && away.dot(normal) < 0;
  if ((open || entangled_) && winding > (behind ? kBehindEdgeWinding : kInsideWinding)) side = -1;
  const double far = std::max(inside, same_side(winding, range_, distance));
  return open && !entangled_ ? std::min(far, over_the_edge(away, normal)) : far;
}

}  // namespace genu
