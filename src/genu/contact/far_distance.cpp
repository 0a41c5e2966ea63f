#include "genu/contact/far_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/distance.h>
#include <Eigen/Geometry>

#include "genu/geometry/mesh_topology.h"
#include "genu/geometry/winding_number.h"

namespace genu {
namespace {

// FCL tests triangles with an absolute 1e-15, which breaks small ones in metres: it is fed millimetres.
constexpr double kMillimetres = 1e3;

using Bvh = fcl::BVHModel<fcl::OBBRSSd>;

/// Angle-weighted normals of the faces, edges and vertices of a mesh (Baerentzen and Aanaes 2005): the sign of
/// (x - nearest) . normal is the side of x whatever feature is nearest.
class FeatureNormals {
 public:
  explicit FeatureNormals(const Mesh& mesh)
      : mesh_(mesh), vertex_(mesh.vertices.size(), Vec3::Zero()), open_vertex_(mesh.vertices.size(), false) {
    edges_.reserve(3 * mesh.triangles.size());
    for (const auto& t : mesh.triangles) add_triangle(t);
    join_edges();
    for (const Edge& edge : edges_) {
      if (edge.faces != 1) continue;
      open_vertex_[static_cast<std::size_t>(edge.i)] = open_vertex_[static_cast<std::size_t>(edge.j)] = true;
    }
  }

  bool any_open() const { return std::find(open_vertex_.begin(), open_vertex_.end(), true) != open_vertex_.end(); }

  /// The normal of the feature of triangle t on which `p` lies; `open` says that it belongs to an edge of the sheet.
  Vec3 at(int triangle, const Vec3& p, bool& open) const {
    const auto& t = mesh_.triangles[static_cast<std::size_t>(triangle)];
    const Vec3 bary = barycentric(t, p);
    constexpr double kOnFeature = 1e-7;  // of the triangle: FCL's nearest points carry about 1e-9
    int zeros = 0;
    std::size_t zero = 0, one = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (bary[static_cast<Eigen::Index>(k)] <= kOnFeature) ++zeros, zero = k;
      if (bary[static_cast<Eigen::Index>(k)] >= 1 - 2 * kOnFeature) one = k;
    }
    open = false;
    if (zeros == 0) return face_normal(t);
    if (zeros >= 2) {
      const auto v = static_cast<std::size_t>(t[one]);
      open = open_vertex_[v];
      return vertex_[v];
    }
    const Edge& edge = edge_between(t[(zero + 1) % 3], t[(zero + 2) % 3]);
    open = edge.faces == 1;
    return edge.normal;
  }

 private:
  struct Edge {
    int i, j;  // i < j
    Vec3 normal;
    int faces;
    bool operator<(const Edge& other) const { return std::pair(i, j) < std::pair(other.i, other.j); }
  };

  const Edge& edge_between(int i, int j) const {
    return *std::lower_bound(edges_.begin(), edges_.end(), Edge{std::min(i, j), std::max(i, j), {}, 0});
  }

  /// Sorts the sides of all triangles and joins those that are the same edge.
  void join_edges() {
    std::stable_sort(edges_.begin(), edges_.end());
    std::size_t last = 0;
    for (std::size_t k = 1; k < edges_.size(); ++k) {
      if (!(edges_[last] < edges_[k])) {
        edges_[last].normal += edges_[k].normal;
        ++edges_[last].faces;
      } else {
        edges_[++last] = edges_[k];
      }
    }
    if (!edges_.empty()) edges_.erase(edges_.begin() + static_cast<std::ptrdiff_t>(last) + 1, edges_.end());
    edges_.shrink_to_fit();
  }

  const Vec3& vertex(int i) const { return mesh_.vertices[static_cast<std::size_t>(i)]; }

  Vec3 face_normal(const std::array<int, 3>& t) const {
    return (vertex(t[1]) - vertex(t[0])).cross(vertex(t[2]) - vertex(t[0])).normalized();
  }

  void add_triangle(const std::array<int, 3>& t) {
    const Vec3 normal = face_normal(t);
    if (!normal.allFinite()) return;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 e1 = vertex(t[(k + 1) % 3]) - vertex(t[k]), e2 = vertex(t[(k + 2) % 3]) - vertex(t[k]);
      vertex_[static_cast<std::size_t>(t[k])] += std::atan2(e1.cross(e2).norm(), e1.dot(e2)) * normal;
      const int i = t[k], j = t[(k + 1) % 3];
      edges_.push_back({std::min(i, j), std::max(i, j), normal, 1});
    }
  }

  Vec3 barycentric(const std::array<int, 3>& t, const Vec3& p) const {
    const Vec3 e1 = vertex(t[1]) - vertex(t[0]), e2 = vertex(t[2]) - vertex(t[0]), d = p - vertex(t[0]);
    const Vec3 n = e1.cross(e2);
    const double area2 = n.squaredNorm();
    const double b1 = d.cross(e2).dot(n) / area2, b2 = e1.cross(d).dot(n) / area2;
    return {1 - b1 - b2, b1, b2};
  }

  const Mesh& mesh_;
  std::vector<Vec3> vertex_;
  std::vector<bool> open_vertex_;
  std::vector<Edge> edges_;  // by (i, j)
};

// Winding numbers from which on a point is inside: between pieces, and behind the edge of an open sheet. Behind the
// edge of a flat one it is at most 1/4, at right angles; behind one that bends round, as a condyle's does, more.
constexpr double kInside = 0.5, kBehindEdge = 0.2;

/// How far a point may go (m) until its winding number can reach kBehindEdge: away from the surface, which is
/// `distance` away, it is a harmonic function, whose gradient at the distance r from x is at most 3 sup|w| / (distance
/// - r) (Gilbarg and Trudinger 2001, section 2.7), and sup|w| is about 1.
double same_side(double winding, double distance) {
  return winding < kBehindEdge ? distance * -std::expm1((winding - kBehindEdge) / 3) : 0;
}

/// Without the triangles that have no area, to rounding: the nearest point on one has no side.
Mesh with_area(Mesh mesh) {
  constexpr double kSmallestSine = 1e-9;
  std::erase_if(mesh.triangles, [&](const auto& t) {
    const auto corner = [&](std::size_t k) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    const Vec3 u = corner(1) - corner(0), v = corner(2) - corner(0), w = corner(2) - corner(1);
    return !(u.cross(v).norm() > kSmallestSine * std::max({u.squaredNorm(), v.squaredNorm(), w.squaredNorm()}));
  });
  return mesh;
}

/// Do the boxes of any two pieces overlap?
bool pieces_may_meet(const Mesh& mesh) {
  const Components parts = connected_components(mesh);
  constexpr int kMost = 64;  // so many pieces are looked at; with more the answer is yes
  if (parts.count < 2 || parts.count > kMost) return parts.count > 1;
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
  explicit Triangles(Mesh m) : mesh(with_area(std::move(m))), normals(mesh) {
    std::vector<Vec3> vertices;
    std::vector<fcl::Triangle> triangles;
    vertices.reserve(mesh.vertices.size());
    triangles.reserve(mesh.triangles.size());
    for (const Vec3& v : mesh.vertices) vertices.push_back(kMillimetres * v);
    for (const auto& t : mesh.triangles)
      triangles.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                             static_cast<std::size_t>(t[2]));
    // The nearest point of one sheet tells the side for certain. At the edge of a hole it tells nothing, and between
    // pieces that run into each other it may lie on the one whose outside x is.
    entangled = pieces_may_meet(mesh);
    if (normals.any_open() || entangled) winding = std::make_unique<WindingNumber>(mesh);
    bvh->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
    bvh->addSubModel(vertices, triangles);
    bvh->endModel();
  }

  Mesh mesh;
  FeatureNormals normals;
  std::unique_ptr<WindingNumber> winding;  // where the nearest point does not tell the side for certain
  bool entangled = false;                  // which is everywhere
  std::shared_ptr<Bvh> bvh = std::make_shared<Bvh>();
};

FarDistance::FarDistance(const Surface& surface, double edge, const Vec3& centre, double reach) : surface_(&surface) {
  if (!surface.knows_distance()) triangles_ = std::make_unique<Triangles>(surface.triangles(edge, centre, reach));
}
FarDistance::~FarDistance() = default;
FarDistance::FarDistance(FarDistance&&) noexcept = default;
FarDistance& FarDistance::operator=(FarDistance&&) noexcept = default;

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
  constexpr double kPoint = 1e-6;  // mm: the radius of the sphere that plays the point
  const fcl::Sphered point(kPoint);
  const fcl::Transform3d here(Eigen::Translation3d(kMillimetres * x));
  fcl::DistanceRequestd request(true);
  request.gjk_solver_type = fcl::GST_INDEP;
  fcl::DistanceResultd result;
  fcl::distance(triangles_->bvh.get(), fcl::Transform3d::Identity(), &point, here, request, result);
  const Vec3 on_mesh = result.nearest_points[0] / kMillimetres;
  const Vec3 away = x - on_mesh;
  const double distance = away.norm();
  bool open = false;
  const Vec3 normal = triangles_->normals.at(result.b1, on_mesh, open).normalized();
  out.beyond_edge = open;
  double side = open || away.dot(normal) >= 0 ? 1.0 : -1.0;
  out.same_side = std::numeric_limits<double>::infinity();
  if (side > 0 && triangles_->winding) {
    const double winding = (*triangles_->winding)(x);
    const bool behind = open && !triangles_->entangled && away.dot(normal) < 0;
    if ((open || triangles_->entangled) && winding > (behind ? kBehindEdge : kInside)) side = -1;
    out.same_side = same_side(winding, distance);
  }
  if (side < 0) out.same_side = 0;
  out.distance = side * distance;
  out.direction = distance > 1e-9 ? Vec3(side * away / distance) : normal;
  return out;
}

}  // namespace genu
