// Self-intersections against CGAL's exact predicates (Polygon Mesh Processing: self_intersections), for manifolds in
// general position: the floating-point answer calls a distance within rounding a touch, CGAL decides it either way.
#include <algorithm>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include "genu/mesh/mesh_topology.h"
#include "genu/mesh_care/mesh_crossings.h"
#include "support/blend_meshes.h"

namespace genu {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// CGAL wants neighbours to be wound alike.
SurfaceMesh to_surface_mesh(Mesh mesh) {
  make_winding_consistent(mesh, mesh_edges(mesh));
  std::vector<Kernel::Point_3> points;
  for (const Vec3& v : mesh.vertices) points.emplace_back(v.x(), v.y(), v.z());
  std::vector<std::vector<std::size_t>> polygons;
  for (const auto& t : mesh.triangles) polygons.emplace_back(t.begin(), t.end());
  EXPECT_TRUE(pmp::is_polygon_soup_a_polygon_mesh(polygons));
  SurfaceMesh out;
  pmp::polygon_soup_to_polygon_mesh(points, polygons, out);
  return out;
}

/// Ascending pairs of triangles, as crossing_triangles() gives them.
std::vector<std::pair<int, int>> exact_pairs(const Mesh& mesh) {
  const SurfaceMesh surface = to_surface_mesh(mesh);
  using Face = SurfaceMesh::Face_index;
  std::vector<std::pair<Face, Face>> found;
  pmp::self_intersections(surface, std::back_inserter(found));
  std::vector<std::pair<int, int>> pairs;
  for (const auto& [a, b] : found) {
    const auto i = static_cast<int>(a.idx()), j = static_cast<int>(b.idx());
    if (i != j) pairs.emplace_back(std::min(i, j), std::max(i, j));  // a pair with itself has no area
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST(CgalCrossings, TheSamePairsOfTwoSpheres) {
  const Mesh one = test::noisy_sphere(10e-3, 3, 0.05e-3);
  std::size_t total = 0;
  for (int k = 0; k < 8; ++k) {
    const Pose shift{exp_rotation(Vec3(0.1, 0.2, 0.3) * k), Vec3(7e-3, 1e-3, -2e-3) * (0.3 + 0.2 * k)};
    const Mesh both = test::joined(one, test::moved(test::noisy_sphere(10e-3, 3, 0.05e-3, 8), shift));
    EXPECT_EQ(crossing_triangles(both), exact_pairs(both)) << k;
    total += crossing_triangles(both).size();
  }
  EXPECT_GT(total, 500u);
}

TEST(CgalCrossings, TheSamePairsOfCrumpledSpheres) {
  for (unsigned seed = 1; seed < 6; ++seed) {  // noise so large that neighbours and neighbours' neighbours cross
    const Mesh crumpled = test::noisy_sphere(10e-3, 3, 0.6e-3, seed);
    EXPECT_EQ(crossing_triangles(crumpled), exact_pairs(crumpled)) << seed;
  }
}

TEST(CgalCrossings, NoneInACleanMesh) {
  EXPECT_TRUE(exact_pairs(test::jittered_torus(15e-3, 5e-3, 2e-3)).empty());
  EXPECT_TRUE(crossing_triangles(test::jittered_torus(15e-3, 5e-3, 2e-3)).empty());
}

}  // namespace
}  // namespace genu
