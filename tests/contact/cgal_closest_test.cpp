// The distance far from a surface against CGAL: the closest point of its AABB tree, the side by counting crossings of
// a ray with exact predicates. Both find the same triangle or one as near; the rest is rounding.
#include <cmath>
#include <cstdio>
#include <random>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include "genu/contact/far_distance.h"
#include "genu/core/timer.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/mesh_files/mesh_reader.h"
#include "genu/surface/analytic.h"
#include "genu/surface/facet_surface.h"
#include "support/data.h"

namespace genu {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<SurfaceMesh>>>;

/// CGAL's copy of a mesh; fewer faces where CGAL refuses some.
SurfaceMesh to_cgal(const Mesh& mesh) {
  SurfaceMesh out;
  std::vector<SurfaceMesh::Vertex_index> vertices;
  for (const Vec3& v : mesh.vertices) vertices.push_back(out.add_vertex({v.x(), v.y(), v.z()}));
  const auto at = [&](int i) { return vertices[static_cast<std::size_t>(i)]; };
  for (const auto& t : mesh.triangles) out.add_face(at(t[0]), at(t[1]), at(t[2]));
  return out;
}

Kernel::Point_3 to_cgal(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

/// Uniform in the box round the mesh, widened by a quarter of its diagonal on every side.
std::vector<Vec3> points_around(const Mesh& mesh, int count) {
  const BoundingBox box = bounding_box(mesh);
  const Vec3 margin = Vec3::Constant(0.25 * box.diagonal());
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double x = unit(random), y = unit(random), z = unit(random);
    points.push_back(box.low - margin + Vec3(x, y, z).cwiseProduct(box.high - box.low + 2 * margin));
  }
  return points;
}

constexpr double kAgreement = 1e-9;  // m

/// Unsigned distances at `count` points, and the time of a query.
void expect_same_distances(const char* name, const Mesh& mesh, int count) {
  const SurfaceMesh twin = to_cgal(mesh);
  ASSERT_EQ(twin.number_of_faces(), mesh.triangles.size());
  Tree tree(faces(twin).begin(), faces(twin).end(), twin);
  tree.accelerate_distance_queries();
  const FacetSurface facets(mesh);
  const FarDistance far(facets);
  const std::vector<Vec3> points = points_around(mesh, count);
  std::vector<double> theirs, ours;
  tree.squared_distance(to_cgal(points[0]));  // builds the tree
  const Timer timer;
  for (const Vec3& x : points) theirs.push_back(std::sqrt(tree.squared_distance(to_cgal(x))));
  const double cgal_seconds = timer.seconds();
  for (const Vec3& x : points) ours.push_back(std::abs(far.nearest(x).distance));
  const double genu_seconds = timer.seconds() - cgal_seconds;
  double worst = 0;
  Vec3 where = Vec3::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_TRUE(std::isfinite(ours[i])) << "at " << points[i].transpose();
    if (std::abs(ours[i] - theirs[i]) <= worst) continue;
    worst = std::abs(ours[i] - theirs[i]);
    where = points[i];
  }
  std::printf("%s, %zu triangles: worst difference %.1e m; a query takes %.1f us (CGAL %.1f us)\n", name,
              mesh.triangles.size(), worst, 1e6 * genu_seconds / count, 1e6 * cgal_seconds / count);
  EXPECT_LT(worst, kAgreement) << "at " << where.transpose();
}

/// The side at `count` points round a closed mesh. Nearer than `kAgreement` there is none.
void expect_same_sides(const Mesh& mesh, int count) {
  const SurfaceMesh twin = to_cgal(mesh);
  ASSERT_TRUE(CGAL::is_closed(twin));
  const CGAL::Side_of_triangle_mesh<SurfaceMesh, Kernel> side(twin);
  const FacetSurface facets(mesh);
  const FarDistance far(facets);
  int inside = 0, wrong = 0;
  for (const Vec3& x : points_around(mesh, count)) {
    const double distance = far.nearest(x).distance;
    const bool in = side(to_cgal(x)) == CGAL::ON_BOUNDED_SIDE;
    inside += in ? 1 : 0;
    wrong += std::abs(distance) > kAgreement && (distance < 0) != in ? 1 : 0;
  }
  std::printf("%d of %d points inside, %d on the wrong side\n", inside, count, wrong);
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(inside, count / 50);
}

TEST(CgalClosest, DistanceAndSideOfATorus) {
  const Mesh mesh = make_torus({}, 0.015, 0.005, false)->triangles(1e-3, Vec3::Zero(), 0.03);
  expect_same_distances("torus", mesh, 2000);
  expect_same_sides(mesh, 2000);
}

TEST(CgalClosest, DistanceAroundAMeasuredFemur) {
  const std::string file = "lenhart2015/ACLC01-R-femur-cart.stl";
  GENU_NEEDS_DATA(file);
  Diagnostics diagnostics;
  auto mesh = read_mesh(test::data_path(file), 1, diagnostics);
  ASSERT_TRUE(mesh);
  make_winding_consistent(*mesh, mesh_edges(*mesh));
  expect_same_distances("femur", *mesh, 2000);
  if (boundary_loops(*mesh, mesh_edges(*mesh)).empty()) expect_same_sides(*mesh, 2000);
}

}  // namespace
}  // namespace genu
