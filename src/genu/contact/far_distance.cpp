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
#include "genu/contact/sheet_side.h"
#include "genu/contact/tolerances.h"
#include "genu/mesh/nearest_point.h"
#include "genu/mesh/tolerances.h"

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

/// Without triangles of zero area (to rounding): a nearest point on one has no side.
Mesh with_area(Mesh mesh) {
  std::erase_if(mesh.triangles, [&](const auto& t) {
    const auto corner = [&](std::size_t k) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    const Vec3 u = corner(1) - corner(0), v = corner(2) - corner(0), w = corner(2) - corner(1);
    return !(u.cross(v).norm() > kDegenerateSine * std::max({u.squaredNorm(), v.squaredNorm(), w.squaredNorm()}));
  });
  return mesh;
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

  void tell_sides() {
    normals.emplace(mesh);
    side = SheetSide::of(mesh, *normals);
  }

  Mesh mesh;
  std::optional<FeatureNormals> normals;
  std::optional<SheetSide> side;  // where the nearest point does not give it reliably
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
  if (side > 0 && triangles_->side) out.same_side = triangles_->side->at(x, away, normal, open, side);
  if (side < 0) out.same_side = 0;
  out.distance = side * distance;
  out.direction = distance > 1e-9 ? Vec3(side * away / distance) : normal;
  return out;
}

}  // namespace genu
