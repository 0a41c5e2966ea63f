// Which of two copies of a triangle stays: closed pieces outward, others in agreement.
#include "genu/mesh/two_sided.h"

#include <gtest/gtest.h>

#include "genu/mesh/mesh_check.h"
#include "genu/mesh/mesh_weld.h"
#include "genu/mesh/solid_inertia.h"
#include "genu/surface/tessellate.h"

namespace genu {
namespace {

const Mesh kBall = geodesic_mesh(Vec3::Constant(0.03), 0.006);

/// Each triangle twice; those of which `inward` is true stand inward first.
template <class Which>
Mesh two_sided(const Mesh& mesh, Which inward) {
  Mesh out;
  out.vertices = mesh.vertices;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    auto first = mesh.triangles[t], second = first;
    std::swap(second[1], second[2]);
    if (inward(t)) std::swap(first, second);
    out.triangles.push_back(first);
    out.triangles.push_back(second);
  }
  return out;
}

TEST(TwoSided, AClosedPieceFacesOutwardWhicheverCopyComesFirst) {
  for (const std::size_t every : {1, 2, 3, 10000}) {
    Mesh mesh = two_sided(kBall, [&](std::size_t t) { return t % every == 0; });
    const WeldReport report = weld(mesh, 1e-9);
    EXPECT_EQ(report.duplicate, kBall.triangles.size());
    EXPECT_EQ(report.both_ways, kBall.triangles.size());
    EXPECT_NEAR(solid_inertia(mesh).volume, solid_inertia(kBall).volume, 1e-18);
    EXPECT_EQ(check_mesh(mesh).flipped, 0u);
  }
}

TEST(TwoSided, AnOpenPieceAgreesWithItsFirstTriangle) {
  for (const bool inward : {false, true}) {
    Mesh cap = kBall;
    std::erase_if(cap.triangles, [&](const auto& t) { return kBall.vertices[at(t[0])].z() > 0; });
    Mesh mesh = two_sided(cap, [&](std::size_t t) { return (t % 2 == 0) == inward; });
    const auto first = mesh.triangles[0];
    weld(mesh, 1e-9);
    EXPECT_EQ(check_mesh(mesh).flipped, 0u);
    const Vec3 a = mesh.vertices[at(mesh.triangles[0][1])];
    EXPECT_EQ(a, kBall.vertices[at(first[1])]);
  }
}

TEST(TwoSided, NextToOneSidedTrianglesTheyAgreeWithThese) {
  Mesh mesh = kBall;
  for (std::size_t t = 0; t < 40; ++t) {  // these stand inward first
    mesh.triangles.push_back(mesh.triangles[t]);
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  }
  EXPECT_EQ(weld(mesh, 1e-9).both_ways, 40u);
  EXPECT_NEAR(solid_inertia(mesh).volume, solid_inertia(kBall).volume, 1e-18);
}

TEST(TwoSided, RepeatsInOneDirectionChangeNothing) {
  Mesh mesh = kBall;
  mesh.triangles.insert(mesh.triangles.end(), kBall.triangles.begin(), kBall.triangles.end());
  const WeldReport report = weld(mesh, 1e-9);
  EXPECT_EQ(report.both_ways, 0u);
  EXPECT_EQ(report.duplicate, kBall.triangles.size());
  EXPECT_EQ(mesh.triangles, kBall.triangles);
}

}  // namespace
}  // namespace genu
