#include "genu/contact/far_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/distance.h>
#include <tbb/parallel_invoke.h>
#include <Eigen/Geometry>

#include "genu/contact/feature_normals.h"
#include "genu/contact/tolerances.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/mesh/tolerances.h"
#include "genu/mesh/winding_number.h"

namespace genu {
namespace {

// FCL tests triangles with an absolute 1e-15, which breaks small ones in metres: it gets millimetres.
constexpr double kMillimetres = 1e3;

using Bvh = fcl::BVHModel<fcl::RSSd>;

/// How far a point may go (m) until its winding number can reach kBehindEdgeWinding: away from the surface, which is
/// `distance` away, it is a harmonic function, whose gradient at the distance r from x is at most 3/2 sup|w| /
/// (distance
/// - r) (Axler, Bourdon and Ramey, Harmonic Function Theory, 2001, theorem 6.26), and sup|w| is about 1.
double same_side(double winding, double distance) {
  return winding < kBehindEdgeWinding ? distance * -std::expm1((winding - kBehindEdgeWinding) / 1.5) : 0;
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
    std::vector<Vec3> vertices;
    std::vector<fcl::Triangle> triangles;
    vertices.reserve(mesh.vertices.size());
    triangles.reserve(mesh.triangles.size());
    for (const Vec3& v : mesh.vertices) vertices.push_back(kMillimetres * v);
    for (const auto& t : mesh.triangles)
      triangles.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                             static_cast<std::size_t>(t[2]));
    bvh->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
    bvh->addSubModel(vertices, triangles);
    bvh->endModel();
  }

  /// The nearest point of a single sheet gives the side reliably. At the edge of a hole it gives none, and between
  /// pieces that intersect it may lie on the wrong piece.
  void tell_sides() {
    normals.emplace(mesh);
    entangled = pieces_may_meet(mesh);
    if (normals->any_open() || entangled) winding = std::make_unique<WindingNumber>(mesh);
  }

  Mesh mesh;
  std::optional<FeatureNormals> normals;
  std::unique_ptr<WindingNumber> winding;  // where the nearest point does not give the side reliably
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
  const fcl::Sphered point(kPointSphereRadius);
  const fcl::Transform3d here(Eigen::Translation3d(kMillimetres * x));
  fcl::DistanceRequestd request(true);
  request.gjk_solver_type = fcl::GST_INDEP;
  fcl::DistanceResultd result;
  fcl::distance(triangles_->bvh.get(), fcl::Transform3d::Identity(), &point, here, request, result);
  const Vec3 on_mesh = result.nearest_points[0] / kMillimetres;
  const Vec3 away = x - on_mesh;
  const double distance = away.norm();
  bool open = false;
  const Vec3 normal = triangles_->normals->at(result.b1, on_mesh, open).normalized();
  out.beyond_edge = open;
  double side = open || away.dot(normal) >= 0 ? 1.0 : -1.0;
  out.same_side = std::numeric_limits<double>::infinity();
  if (side > 0 && triangles_->winding) {
    const double winding = (*triangles_->winding)(x);
    const bool behind = open && !triangles_->entangled && away.dot(normal) < 0;
    if ((open || triangles_->entangled) && winding > (behind ? kBehindEdgeWinding : kInsideWinding)) side = -1;
    out.same_side = same_side(winding, distance);
  }
  if (side < 0) out.same_side = 0;
  out.distance = side * distance;
  out.direction = distance > 1e-9 ? Vec3(side * away / distance) : normal;
  return out;
}

}  // namespace genu
