#include "genu/shape_fit/solid_mesh.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "genu/mesh/mesh_check.h"
#include "genu/mesh/solid_inertia.h"
#include "genu/mesh/vertex_fans.h"
#include "genu/mesh_care/mesh_crossings.h"
#include "genu/surface/tessellate.h"

namespace genu {
namespace {

using Shape = SolidPart::Shape;
using Operation = SolidPart::Operation;
using std::numbers::pi;

SolidPart ball(double radius, const Vec3& centre = Vec3::Zero()) {
  SolidPart p;
  p.radius = radius;
  p.placement.p = centre;
  return p;
}

double area(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const auto v = [&](std::size_t k) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    sum += 0.5 * (v(1) - v(0)).cross(v(2) - v(0)).norm();
  }
  return sum;
}

/// Closed, a manifold in edges and vertices, outward.
void expect_closed(Mesh mesh) {
  const MeshReport r = check_mesh(mesh);
  EXPECT_EQ(r.boundary_edges, 0u);
  EXPECT_EQ(r.non_manifold_edges, 0u);
  EXPECT_EQ(r.flipped, 0u);
  EXPECT_TRUE(r.orientable);
  EXPECT_EQ(split_fans(mesh), 0u);
  EXPECT_GT(solid_inertia(mesh).volume, 0);
}

TEST(SolidMesh, MarchingIsClosedForWhateverFunction) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 20; ++trial) {
    // Noise on every node, so that every case of signs comes up: no surface could be worse.
    const auto noise = [&](const Vec3& x) { return x.cwiseAbs().maxCoeff() > 4.5 ? 1.0 : normal(random); };
    const Mesh mesh = marching_tetrahedra(noise, {Vec3::Constant(-6), Vec3::Constant(6)}, 1);
    expect_closed(mesh);
    EXPECT_TRUE(crossing_triangles(mesh).empty());
  }
}

TEST(SolidMesh, ANodeOnTheSurfaceIsNoTrouble) {
  const auto cube = [](const Vec3& x) { return x.cwiseAbs().maxCoeff() - 2; };
  const Mesh mesh = marching_tetrahedra(cube, {Vec3::Constant(-4), Vec3::Constant(4)}, 1);
  expect_closed(mesh);
  EXPECT_EQ(check_mesh(mesh).components, 1);
}

TEST(SolidMesh, VolumeAndAreaOfABallConverge) {
  const double R = 0.02, V = 4 * pi / 3 * R * R * R, A = 4 * pi * R * R;
  double last[2] = {};
  for (int level = 0; level < 3; ++level) {
    const double edge = 5e-3 / (1 << level);
    std::string why;
    const Mesh mesh = solid_mesh(SolidField({ball(R, {0.1, 0.2, -0.3})}), edge, why);
    ASSERT_EQ(why, "");
    expect_closed(mesh);
    for (const Vec3& v : mesh.vertices) ASSERT_NEAR((v - Vec3(0.1, 0.2, -0.3)).norm(), R, 1e-12);
    const MeshReport r = check_mesh(mesh);
    EXPECT_NEAR(r.edge_length[2], edge, 0.15 * edge) << "the median edge is what was asked for";
    EXPECT_LT(r.edge_length[4], 1.6 * edge);
    EXPECT_GT(smallest_angle(mesh), 20 * pi / 180);
    const double error[] = {1 - solid_inertia(mesh).volume / V, 1 - area(mesh) / A};
    for (int k = 0; k < 2; ++k) {
      EXPECT_GT(error[k], 0) << "inside what bulges";
      if (level > 0) {
        EXPECT_NEAR(std::log2(last[k] / error[k]), 2, 0.35);
      }
      last[k] = error[k];
    }
  }
  EXPECT_LT(last[0], 3e-3);
}

TEST(SolidMesh, OfRandomUnionsAndCutsIsClosed) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto place = [&](double half) -> Vec3 {
    return half * Vec3{2 * uniform(random) - 1, 2 * uniform(random) - 1, 2 * uniform(random) - 1};
  };
  for (int trial = 0; trial < 12; ++trial) {
    std::vector<SolidPart> parts{ball(0.02)};
    for (int k = 0; k < 6; ++k) {
      SolidPart p = ball(0.006 + 0.01 * uniform(random), place(0.02));
      p.shape = std::array{Shape::sphere, Shape::ellipsoid, Shape::rod}[static_cast<std::size_t>(k % 3)];
      p.radii = Vec3(0.008, 0.012, 0.016);
      p.placement.R = exp_rotation(place(3));
      p.from = place(0.01);
      p.to = place(0.02);
      p.end_radius = 0.006;
      p.blend = 0.004;
      p.operation = k == 4 ? Operation::cut : Operation::join;
      parts.push_back(p);
    }
    std::string why;
    const SolidField field(parts);
    const Mesh mesh = solid_mesh(field, 2e-3, why);
    ASSERT_EQ(why, "") << trial;
    expect_closed(mesh);
    for (const Vec3& v : mesh.vertices) ASSERT_NEAR(field(v).f, 0, 1e-12);
    const Mesh again = solid_mesh(field, 2e-3, why);
    EXPECT_EQ(again.triangles, mesh.triangles);
    EXPECT_EQ(again.vertices, mesh.vertices);
  }
}

TEST(SolidMesh, SaysWhyThereIsNone) {
  std::string why;
  for (const double coarse : {0.015, 0.03, 1.0}) {
    why.clear();
    EXPECT_TRUE(solid_mesh(SolidField({ball(0.02)}), coarse, why).empty()) << coarse;
    EXPECT_FALSE(why.empty()) << coarse;
  }
  EXPECT_TRUE(solid_mesh(SolidField({ball(0.02)}), 2e-4, why).empty());
  EXPECT_NE(why.find("longer edges"), std::string::npos) << why;
  EXPECT_TRUE(solid_mesh(SolidField({ball(0.02)}), 1e-6, why).empty());
  EXPECT_NE(why.find("too large for its edges"), std::string::npos) << why;
  SolidPart gone = ball(0.03);
  gone.operation = Operation::cut;
  EXPECT_TRUE(solid_mesh(SolidField({ball(0.02), gone}), 1e-3, why).empty());
  EXPECT_NE(why.find("nothing inside"), std::string::npos) << why;
}

}  // namespace
}  // namespace genu
