#include "genu/contact/far_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <fcl/geometry/bvh/BVH_model.h>
#include <tbb/parallel_invoke.h>
#include <Eigen/Geometry>

#include "genu/contact/feature_normals.h"
#include "genu/contact/tolerances.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/mesh/nearest_point.h"
#include "genu/mesh/tolerances.h"
#include "genu/mesh/winding_number.h"

namespace genu {
namespace {

using Bvh = fcl::BVHModel<fcl::AABBd>;

/// Through FCL's tree of boxes to the triangle nearest to a point, the nearer box first. FCL's own walk takes twice as
/// long, and its test of a triangle three times (it knows no points, only spheres); its absolute 1e-15 breaks small
/// triangles in metres.
class ToNearest {
 public:
  ToNearest(const Bvh& tree, const Vec3& point) : tree_(tree), x_(point) {
    if (tree.num_tris > 0) walk(0, square_to(0));  // without triangles it is a tree of vertices
  }

  double square = std::numeric_limits<double>::infinity();  ///< m^2
  int triangle = -1;
  Vec3 at = Vec3::Zero();

 private:
  double square_to(int box) const {
    const fcl::AABBd& b = tree_.getBV(box).bv;
    return (b.min_ - x_).cwiseMax(x_ - b.max_).cwiseMax(0.0).squaredNorm();
  }

  void walk(int box, double square_of_box) {
    if (square_of_box >= square) return;
    const auto& node = tree_.getBV(box);
    if (node.isLeaf()) return look_at(node.primitiveId());
    const int left = node.leftChild(), right = node.rightChild();
    const double to_left = square_to(left), to_right = square_to(right);
    const bool right_first = to_right < to_left;
    walk(right_first ? right : left, right_first ? to_right : to_left);
    walk(right_first ? left : right, right_first ? to_left : to_right);
  }

  void look_at(int t) {
    const fcl::Triangle& corner = tree_.tri_indices[t];
    const Vec3* v = tree_.vertices;
    const Vec3 p = nearest_on_triangle(x_, v[corner[0]], v[corner[1]], v[corner[2]]);
    const double d = (p - x_).squaredNorm();
    if (!(d < square)) return;
    square = d;
    triangle = t;
    at = p;
  }

  const Bvh& tree_;
  const Vec3& x_;
};

/// Half of what the winding number ranges over: away from the sheet it is a harmonic function, largest and smallest at
/// the sheet itself. Seen from both sides of the middles of some triangles; another sheet may be just behind.
double half_range_of(const WindingNumber& winding, const Mesh& mesh) {
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
  return kWindingReserve * 0.5 * (high - low);
}

/// How far a point may go (m) until its winding number can reach kBehindEdgeWinding: away from the surface, which is
/// `distance` away, its gradient at the distance r from x is at most 3/2 half_range / (distance - r) (Axler, Bourdon
/// and Ramey, Harmonic Function Theory, 2001, theorem 6.26).
double same_side(double winding, double half_range, double distance) {
  const double left = kBehindEdgeWinding - winding - kWindingError;
  return left > 0 ? distance * -std::expm1(-left / (1.5 * half_range)) : 0;
}

/// How far a point beyond an edge may go (m) until it is behind the sheet itself, which tells its side: to the plane
/// that stands on the edge. Faces beside the edge have other normals than it. Infinite where it is well in front.
double over_the_edge(const Vec3& away, const Vec3& normal) {
  const double height = away.dot(normal), turned = kEdgeTurn * away.norm();
  if (height > turned) return std::numeric_limits<double>::infinity();
  return std::max(0.0, (away - height * normal).norm() - turned);
}

/// Without triangles of zero area (to rounding): a nearest point on one has no side.
Mesh with_area(Mesh mesh) {
  std::erase_if(mesh.triangles, [&](const auto& t) {
    const auto corner = [&](std::size_t k) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    const Vec3 u = corner(1) - corner(0), v = corner(2) - corner(0), w = corner(2) - corner(1);
    return !(u.cross(v).norm() > kDegenerateSine * std::max({u.squaredNorm(), v.squaredNorm(), w.squaredNorm()}));
  });
  return mesh;
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

struct FarDistance::Triangles {
  explicit Triangles(Mesh m) : mesh(with_area(std::move(m))) {
    tbb::parallel_invoke([this] { build_tree(); }, [this] { tell_sides(); });
  }

  void build_tree() {
    std::vector<fcl::Triangle> triangles;
    triangles.reserve(mesh.triangles.size());
    for (const auto& t : mesh.triangles)
      triangles.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                             static_cast<std::size_t>(t[2]));
    bvh->beginModel(static_cast<int>(triangles.size()), static_cast<int>(mesh.vertices.size()));
    bvh->addSubModel(mesh.vertices, triangles);
    bvh->endModel();
  }

  /// The nearest point of a single sheet gives the side reliably. At the edge of a hole it gives none, and between
  /// pieces that intersect it may lie on the wrong piece.
  void tell_sides() {
    normals.emplace(mesh);
    entangled = pieces_may_meet(mesh);
    if (!normals->any_open() && !entangled) return;
    winding = std::make_unique<WindingNumber>(mesh);
    half_range = half_range_of(*winding, mesh);
  }

  Mesh mesh;
  std::optional<FeatureNormals> normals;
  std::unique_ptr<WindingNumber> winding;  // where the nearest point does not give the side reliably
  double half_range = 1;                   // of the winding number
  bool entangled = false;                  // that is so everywhere
  std::shared_ptr<Bvh> bvh = std::make_shared<Bvh>();
};

FarDistance::FarDistance(const Surface& surface, double edge, const Vec3& centre, double reach) : surface_(&surface) {
  if (!surface.knows_distance()) triangles_ = std::make_shared<const Triangles>(surface.triangles(edge, centre, reach));
}

FarDistance::Nearest FarDistance::nearest(const Vec3& x) const {
  Nearest out;
  if (!triangles_) {
    SurfacePoint foot;
    const auto gap = surface_->gap(x);
    if (gap && surface_->project(x, foot)) {
      out.distance = *gap;
      out.direction = foot.n;
    }
    return out;
  }
  const ToNearest found(*triangles_->bvh, x);
  if (found.triangle < 0) {  // there is none
    out.distance = out.same_side = std::numeric_limits<double>::infinity();
    return out;
  }
  const Vec3& on_mesh = found.at;
  const Vec3 away = x - on_mesh;
  const double distance = away.norm();
  bool open = false;
  const Vec3 normal = triangles_->normals->at(found.triangle, on_mesh, open).normalized();
  out.beyond_edge = open;
  double side = open || away.dot(normal) >= 0 ? 1.0 : -1.0;
  out.same_side = std::numeric_limits<double>::infinity();
  if (side > 0 && triangles_->winding) {
    const double winding = (*triangles_->winding)(x);
    const bool behind = open && !triangles_->entangled && away.dot(normal) < 0;
    if ((open || triangles_->entangled) && winding > (behind ? kBehindEdgeWinding : kInsideWinding)) side = -1;
    out.same_side = same_side(winding, triangles_->half_range, distance);
    if (open && !triangles_->entangled) out.same_side = std::min(out.same_side, over_the_edge(away, normal));
  }
  if (side < 0) out.same_side = 0;
  out.distance = side * distance;
  out.direction = distance > 1e-9 ? Vec3(side * away / distance) : normal;
  return out;
}

}  // namespace genu
