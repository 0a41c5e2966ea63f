#include "genu/surface/tessellate.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "genu/mesh/mesh_check.h"
#include "genu/surface/analytic.h"
#include "genu/surface/tolerances.h"

namespace genu {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

const Pose kPlace{exp_rotation({0.3, -1.2, 0.7}), Vec3(0.01, -0.02, 0.05)};

double volume(const Mesh& mesh, const Vec3& origin) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const auto corner = [&](std::size_t k) -> Vec3 { return mesh.vertices[static_cast<std::size_t>(t[k])] - origin; };
    sum += corner(0).dot(corner(1).cross(corner(2))) / 6;
  }
  return sum;
}

struct CutShape {
  std::string name;
  std::unique_ptr<Surface> (*make)(bool inside);
  double volume;          ///< m^3, of closed shapes; 0 for open ones
  double smallest_angle;  ///< deg, of the meshes below
};

void PrintTo(const CutShape& s, std::ostream* out) { *out << s.name; }

std::vector<CutShape> cut_shapes() {
  using std::numbers::pi;
  return {
      {"sphere", [](bool i) { return make_sphere(kPlace, 0.02, i); }, 4 * pi / 3 * 8e-6, 35},
      {"ellipsoid",
       [](bool i) {
         return make_ellipsoid(kPlace, {0.03, 0.02, 0.012}, i);
       },
       4 * pi / 3 * 7.2e-6, 25},
      {"needle",
       [](bool i) {
         return make_ellipsoid(kPlace, {0.03, 0.006, 0.005}, i);
       },
       4 * pi / 3 * 0.9e-6, 25},
      {"lens",
       [](bool i) {
         return make_ellipsoid(kPlace, {0.02, 0.02, 0.006}, i);
       },
       4 * pi / 3 * 2.4e-6, 15},
      {"torus", [](bool i) { return make_torus(kPlace, 0.015, 0.005, i); }, 2 * pi * pi * 0.015 * 25e-6, 35},
      {"plane", [](bool i) { return make_plane(kPlace, i); }, 0, 40},
      {"cylinder", [](bool i) { return make_cylinder(kPlace, 0.02, i); }, 0, 40},
      {"polynomial",
       [](bool i) {
         return make_polynomial(kPlace, {{2, 0, 30}, {1, 1, 9}, {0, 2, -9}}, i);
       },
       0, 20},
      {"condyle",
       [](bool i) {
         return make_cylindrical_polynomial(kPlace, {{0, 0, 0.02}, {0, 2, -9}, {1, 0, 1e-3}}, i);
       },
       0, 20},
  };
}

class Tessellation : public ::testing::TestWithParam<CutShape> {};

TEST_P(Tessellation, LiesOnTheSurfaceIsSoundAndFacesOutward) {
  for (const double edge : {4e-3, 1e-3}) {
    for (const bool inside : {false, true}) {
      const auto surface = GetParam().make(inside);
      const Mesh mesh = surface->triangles(edge, kPlace.p, 0.02);
      const MeshReport report = check_mesh(mesh);
      EXPECT_EQ(report.components, 1);
      EXPECT_EQ(report.non_manifold_edges + report.flipped + report.degenerate, 0u);
      EXPECT_EQ(report.boundary_edges == 0, GetParam().volume > 0);
      EXPECT_GT(smallest_angle(mesh) / kDegree, GetParam().smallest_angle) << edge;
      double off = 0;
      for (const Vec3& v : mesh.vertices) off = std::max(off, std::abs(surface->gap(v).value_or(1)));
      EXPECT_LT(off, 1e-15);
      double facing = 1;
      for (const auto& t : mesh.triangles) {
        const auto corner = [&](std::size_t k) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
        SurfacePoint s;
        ASSERT_TRUE(surface->project((corner(0) + corner(1) + corner(2)) / 3, s));
        facing = std::min(facing, (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized().dot(s.n));
      }
      EXPECT_GT(facing, 0.8) << edge;
    }
  }
}

TEST_P(Tessellation, VolumeConvergesWithTheSquareOfTheEdge) {
  if (GetParam().volume == 0) return;
  const auto surface = GetParam().make(false);
  const double coarse = volume(surface->triangles(1.2e-3, kPlace.p, 0.02), kPlace.p) / GetParam().volume - 1;
  const double fine = volume(surface->triangles(0.6e-3, kPlace.p, 0.02), kPlace.p) / GetParam().volume - 1;
  EXPECT_LT(std::abs(coarse), 0.02);
  EXPECT_NEAR(coarse / fine, 4, 0.8);
}

TEST_P(Tessellation, IsTheSameEveryTime) {
  const Mesh a = GetParam().make(false)->triangles(1e-3, kPlace.p, 0.02);
  const Mesh b = GetParam().make(false)->triangles(1e-3, kPlace.p, 0.02);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_TRUE(a.vertices == b.vertices);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Tessellation, ::testing::ValuesIn(cut_shapes()),
                         [](const auto& s) { return s.param.name; });

TEST(TessellationGrading, EdgesShrinkWhereTheSurfaceBends) {
  // The rim of a lens: radius of curvature c^2 / a = 0.2 mm, against a^2 / c = 200 mm at the poles.
  const Mesh mesh = make_ellipsoid({}, {0.02, 0.02, 0.002}, false)->triangles(2e-3, Vec3::Zero(), 1);
  double rim = 0, pole = 0;
  for (const MeshEdge& e : mesh_edges(mesh)) {
    const Vec3 &a = mesh.vertices[static_cast<std::size_t>(e.v[0])],
               &b = mesh.vertices[static_cast<std::size_t>(e.v[1])];
    const double radius = (0.5 * (a + b)).head<2>().norm(), length = (a - b).norm();
    if (radius > 0.0199) rim = std::max(rim, length);
    if (radius < 0.005) pole = std::max(pole, length);
  }
  EXPECT_LT(rim, 4.0 / 3 * 0.12e-3 * 1.5);
  EXPECT_GT(pole, 1e-3);
}

TEST(TessellationBounds, AFineEdgeOnALargeSurfaceStaysAffordable) {
  EXPECT_LT(make_plane({}, false)->triangles(1e-6, Vec3::Zero(), 0.05).triangles.size(), 1.05 * kMaxTriangles);
  EXPECT_LT(make_torus({}, 0.015, 0.005, false)->triangles(1e-6, Vec3::Zero(), 1).triangles.size(),
            1.3 * kMaxTriangles);
  const Mesh steep = make_polynomial({}, {{20, 0, 1e30}}, false)->triangles(1e-3, Vec3::Zero(), 0.05);
  EXPECT_LT(steep.triangles.size(), 1.5 * kMaxTriangles);
}

}  // namespace
}  // namespace genu
